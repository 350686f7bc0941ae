#include "tools/figures/run/warm_robot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>

#include "tests/support/refusal.h"
#include "tests/tools/figures/look.h"
#include "tools/figures/run/simulation_figures.h"
#include "tools/scene/context.h"

namespace warmjoint::figures {
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
  const auto images = RenderWarmRobot(view, TestContext(), {0, last}, 300, 300);
  ASSERT_TRUE(images.has_value());
  const Rgb cold = HeatColour(0), hot = HeatColour(1);
  EXPECT_GT(ShareLike((*images)[0], cold), 0.01);
  EXPECT_LT(ShareLike((*images)[0], hot), 0.001);
  EXPECT_GT(ShareLike((*images)[1], hot), 0.01);
  EXPECT_LT(ShareLike((*images)[1], cold), 0.001);
  // the corners are the page's paper, the rest of the robot stands between
  EXPECT_EQ((*images)[0].At(0, 0), (Rgb{255, 255, 255}));
  EXPECT_LT(ShareLike((*images)[0], {255, 255, 255}), 0.99);
}

/// Columns and rows of the picture that show anything: first, last.
std::array<int, 4> ExtentOf(const Image& image) {
  std::array<int, 4> extent{image.width, -1, image.height, -1};
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (image.At(x, y) == Rgb{255, 255, 255}) continue;
      extent = {std::min(extent[0], x), std::max(extent[1], x), std::min(extent[2], y),
                std::max(extent[3], y)};
    }
  }
  return extent;
}

TEST(WarmRobot, FillsThePictureAndStaysInside) {
  const SimulationView view = ExampleSimulation();
  const auto images = RenderWarmRobot(view, TestContext(), {0, 19}, 240, 200);
  int left = 240, right = -1, top = 200, bottom = -1;
  for (const Image& image : *images) {
    const auto [x0, x1, y0, y1] = ExtentOf(image);
    left = std::min(left, x0);
    right = std::max(right, x1);
    top = std::min(top, y0);
    bottom = std::max(bottom, y1);
  }
  EXPECT_GT(std::min({left, 239 - right, top, 199 - bottom}), 0) << "nothing is cut";
  EXPECT_TRUE(right - left > 0.85 * 240 || bottom - top > 0.85 * 200);
}

TEST(WarmRobot, MovesWithTheRecording) {
  const SimulationView view = ExampleSimulation();
  // sample 19 is the end of the first turn, a radian from the start
  const auto images = RenderWarmRobot(view, TestContext(), {0, 19}, 200, 200);
  int differing = 0;
  for (std::size_t i = 0; i < (*images)[0].pixels.size(); ++i) {
    differing += std::abs((*images)[0].pixels[i] - (*images)[1].pixels[i]) > 40;
  }
  EXPECT_GT(differing, 1200);
}

TEST(WarmRobot, StandsBesideTheTorqueThatItsHeatChanges) {
  const SimulationView view = ExampleSimulation();
  const Figure figure = *MakeWarmRobot(view, TestContext());
  const Shown drawn = Look(figure);
  EXPECT_EQ(std::get<Picture>(figure.panels[0].content).png.substr(1, 3), "PNG");
  const ShownPlot& torque = drawn.plots[1];
  // cold: 15 + 5 0.05 always; measured: 7.6 less at the end, of which a segment may be left out
  const ShownSeries& cold = SeriesNamed(torque, "the mean if it had stayed cold");
  EXPECT_NEAR(cold.y.first, 15.25, 1e-9);
  EXPECT_NEAR(cold.y.second, 15.25, 1e-9);
  EXPECT_EQ(cold.hue, Hue::blue);
  // of 20 s each, over which E changes by 8 N.m 20 / 200 = 0.8 at most
  EXPECT_NEAR(SeriesNamed(torque, "its mean at each speed").y.first, 15.25 - 7.6, 0.2);
  EXPECT_NEAR(SeriesNamed(torque, "its mean at each speed").y.second, 15.25 - 0.4, 0.1);
  EXPECT_NEAR(SeriesNamed(torque, "friction").y.first, 15.25 - 7.6, 0.1);
  EXPECT_THAT(figure.finding, HasSubstr("by −7.60 N·m at most, after"));
}

TEST(WarmRobot, IsNothingWithoutARobotOrWarming) {
  SimulationView view = ExampleSimulation();
  view.scenario.plant = PlantKind::ideal;
  EXPECT_FALSE(MakeWarmRobot(view, TestContext()));
  view = ExampleSimulation();
  view.fit.energy.setZero();
  EXPECT_FALSE(MakeWarmRobot(view, TestContext()));
}

TEST(SimulationFigures, AreNamedAsTheirFiles) {
  LookAtAll(SimulationFigures(), ExampleSimulation());
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
}  // namespace warmjoint::figures
