#include "tools/shown/run/warm_robot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/support/refusal.h"
#include "tools/scene/context.h"
#include "tools/shown/run/simulation_view.h"

namespace warmjoint::shown {
namespace {

using scene::GlContext;
using scene::Image;
using scene::MakeEglContext;
using scene::MakeGlContext;
using scene::Rgb;
using ::testing::HasSubstr;

/// Ten minutes of a robot's joint that turns there and back and warms, without an engine.
SimulationView ExampleSimulation() {
  constexpr Eigen::Index kSamples = 600;
  Scenario scenario;
  scenario.name = "warm arm";
  scenario.plant = PlantKind::mujoco;
  scenario.robot = "irb140_like";
  scenario.joint = "joint_2";
  Simulation recording;
  Measurements& m = recording.measurements;
  m.time = Eigen::VectorXd::LinSpaced(kSamples, 0, kSamples - 1);
  m.velocity = ((m.time / 20).array().floor().unaryExpr([](double k) {
                 return std::fmod(k, 2) == 0 ? 0.05 : -0.05;
               })).matrix();
  m.position = Eigen::VectorXd::Zero(kSamples);
  for (Eigen::Index i = 1; i < kSamples; ++i) {
    m.position[i] = m.position[i - 1] + m.velocity[i - 1];
  }
  Truth& truth = recording.truth;
  truth.friction.parameters = {{"viscous", 5}, {"coulomb", 15}};
  truth.friction.thermal = Thermal{-1, 200};
  truth.velocity = m.velocity;
  truth.energy = -8 * (1 - (-m.time.array() / 200).exp());
  truth.force = 5 * m.velocity.array() + m.velocity.array().sign() * (15 + truth.energy.array());
  truth.loss = truth.force.cwiseProduct(m.velocity);
  m.torque = truth.force;
  return MakeSimulationView(scenario, recording);
}

/// Share of pixels of about that colour's hue: shading makes it darker, never another hue.
double ShareLike(const Image& image, Rgb colour) {
  const double norm = std::hypot(colour.red, colour.green, colour.blue);
  int alike = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Rgb p = image.At(x, y);
      const double length = std::hypot(p.red, p.green, p.blue);
      const double cosine = (p.red * colour.red + p.green * colour.green + p.blue * colour.blue) /
                            (norm * std::max(1.0, length));
      alike += length > 40 && cosine > 0.99;
    }
  }
  return static_cast<double>(alike) / (image.width * image.height);
}

/// The GL context of this test program.
GlContext& TestContext() {
  static const std::unique_ptr<GlContext> context = MakeGlContext();
  return *context;
}

TEST(WarmRobot, PaintsTheJointsLinkInTheColourOfItsHeat) {
  const SimulationView view = ExampleSimulation();
  const Eigen::Index last = view.fit.time.size() - 1;
  const auto pictures = RenderWarmRobot(view, TestContext(), {0, last}, 300, 300);
  const Rgb cold = HeatColour(0), hot = HeatColour(1);
  EXPECT_GT(ShareLike(pictures[0].image, cold), 0.01);
  EXPECT_LT(ShareLike(pictures[0].image, hot), 0.001);
  EXPECT_GT(ShareLike(pictures[1].image, hot), 0.01);
  EXPECT_LT(ShareLike(pictures[1].image, cold), 0.001);
  // the corners are the page's paper, the rest of the robot stands between
  EXPECT_EQ(pictures[0].image.At(0, 0), (Rgb{255, 255, 255}));
  EXPECT_LT(ShareLike(pictures[0].image, {255, 255, 255}), 0.99);
}

TEST(WarmRobot, HasColoursThatDarkenFromColdToHot) {
  double before = 3 * 255.0 + 1;
  for (const Rgb& colour : HeatColours()) {
    const double light = 0.0 + colour.red + colour.green + colour.blue;
    EXPECT_LT(light, before);
    before = light;
  }
  EXPECT_EQ(HeatColour(0), HeatColours().front());
  EXPECT_EQ(HeatColour(1), HeatColours().back());
}

/// Columns and rows of the picture that show the robot, which is darker than floor and paper: first, last.
std::array<int, 4> ExtentOf(const Image& image) {
  constexpr int kFloor = 200;  // the floor's shade is above, shadows of its rim too
  std::array<int, 4> extent{image.width, -1, image.height, -1};
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (image.At(x, y).green > kFloor) continue;
      extent = {std::min(extent[0], x), std::max(extent[1], x), std::min(extent[2], y),
                std::max(extent[3], y)};
    }
  }
  return extent;
}

TEST(WarmRobot, FillsThePictureAndStaysInside) {
  const SimulationView view = ExampleSimulation();
  const auto pictures = RenderWarmRobot(view, TestContext(), {0, 19}, 240, 200);
  int left = 240, right = -1, top = 200, bottom = -1;
  for (const RobotPicture& picture : pictures) {
    const auto [x0, x1, y0, y1] = ExtentOf(picture.image);
    left = std::min(left, x0);
    right = std::max(right, x1);
    top = std::min(top, y0);
    bottom = std::max(bottom, y1);
  }
  EXPECT_GT(std::min({left, 239 - right, top, 199 - bottom}), 0) << "nothing is cut";
  EXPECT_TRUE(right - left > 0.8 * 240 || bottom - top > 0.8 * 200);
}

TEST(WarmRobot, MovesWithTheRecordingAboutAnAxisThatStays) {
  const SimulationView view = ExampleSimulation();
  // sample 19 is the end of the first turn, a radian from the start
  const auto pictures = RenderWarmRobot(view, TestContext(), {0, 19}, 200, 200);
  int differing = 0;
  for (std::size_t i = 0; i < pictures[0].image.pixels.size(); ++i) {
    differing += std::abs(pictures[0].image.pixels[i] - pictures[1].image.pixels[i]) > 40;
  }
  EXPECT_GT(differing, 1200);
  EXPECT_EQ(pictures[0].axis, pictures[1].axis);
  for (const scene::Pixel& end : pictures[0].axis) {
    EXPECT_TRUE(end[0] > 0 && end[0] < 200 && end[1] > 0 && end[1] < 200);
  }
}

TEST(WarmRobot, IsThereOnlyWithARobotThatWarms) {
  SimulationView view = ExampleSimulation();
  EXPECT_TRUE(HasWarmRobot(view));
  ShownData data;
  const Tree facts = WarmRobotFacts(view, TestContext(), data);
  EXPECT_EQ(facts["pictures"].size(), 2u);
  EXPECT_EQ(facts["pictures"][0]["pixels"]["shape"], (Tree{640, 880}));
  view.scenario.plant = PlantKind::ideal;
  EXPECT_FALSE(HasWarmRobot(view));
  view = ExampleSimulation();
  view.fit.energy.setZero();
  EXPECT_FALSE(HasWarmRobot(view));
}

/// Sets an environment variable for as long as it lives.
class Variable {
 public:
  explicit Variable(const char* value) { setenv("WARMJOINT_GL", value, 1); }
  ~Variable() { unsetenv("WARMJOINT_GL"); }
};

TEST(GlContext, IsTheOneThatTheVariableForces) {
  {
    Variable forced("osmesa");
    EXPECT_EQ(MakeGlContext()->Name(), "osmesa");
  }
  if (!MakeEglContext()) GTEST_SKIP() << "this machine has no EGL without a display";
  Variable forced("egl");
  EXPECT_THAT(MakeGlContext()->Name(), HasSubstr("egl"));
}

TEST(GlContext, RefusesAnUnknownKind) {
  Variable forced("osmessa");
  EXPECT_THAT(test::RefusalOf([] { MakeGlContext(); }),
              HasSubstr("WARMJOINT_GL: unknown value 'osmessa'; did you mean"));
}

}  // namespace
}  // namespace warmjoint::shown
