#include "tools/report/simulation/warm_robot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "models/foundation/bad_input.h"
#include "tests/tools/report/look.h"
#include "tools/report/draw/draw_series.h"
#include "tools/report/gl/context.h"
#include "tools/report/simulation/simulation_figures.h"

namespace warmjoint::report {
namespace {

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
  const auto images = RenderWarmRobot(view, TestContext(), {0, last}, 300, 300, LightTheme());
  ASSERT_TRUE(images.has_value());
  const Rgb cold = HeatColour(0), hot = HeatColour(1);
  EXPECT_GT(ShareLike((*images)[0], cold), 0.01);
  EXPECT_LT(ShareLike((*images)[0], hot), 0.001);
  EXPECT_GT(ShareLike((*images)[1], hot), 0.01);
  EXPECT_LT(ShareLike((*images)[1], cold), 0.001);
  // the corners are the page's paper, the rest of the robot stands between
  EXPECT_EQ((*images)[0].At(0, 0), LightTheme().background);
  EXPECT_LT(ShareLike((*images)[0], {255, 255, 255}), 0.99);
}

TEST(WarmRobot, MovesWithTheRecording) {
  const SimulationView view = ExampleSimulation();
  // sample 19 is the end of the first turn, a radian from the start
  const auto images = RenderWarmRobot(view, TestContext(), {0, 19}, 200, 200, LightTheme());
  int differing = 0;
  for (int i = 0; i < 200 * 200; ++i) {
    differing +=
        Distance((*images)[0].At(i % 200, i / 200), (*images)[1].At(i % 200, i / 200)) > 40;
  }
  EXPECT_GT(differing, 400);
}

TEST(WarmRobot, StandsBesideTheTorqueThatItsHeatChanges) {
  const SimulationView view = ExampleSimulation();
  const Figure figure = *MakeWarmRobot(view, TestContext());
  const Drawn drawn = DrawLight(figure);
  EXPECT_EQ(drawn.pictures.size(), 2u);
  const DrawnPlot& torque = drawn.plots[0];
  // cold: 15 + 5 0.05 always; measured: 7.6 less at the end, of which a segment may be left out
  const DrawnSeries& cold = SeriesNamed(torque, "the mean if it had stayed cold");
  EXPECT_NEAR(cold.y.first, 15.25, 1e-9);
  EXPECT_NEAR(cold.y.second, 15.25, 1e-9);
  EXPECT_EQ(cold.colour, LightTheme().Colour(Hue::blue));
  // of 20 s each, over which E changes by 8 N.m 20 / 200 = 0.8 at most
  EXPECT_NEAR(SeriesNamed(torque, "its mean at each speed").y.first, 15.25 - 7.6, 0.2);
  EXPECT_NEAR(SeriesNamed(torque, "its mean at each speed").y.second, 15.25 - 0.4, 0.1);
  EXPECT_NEAR(SeriesNamed(torque, "measured").y.first, 15.25 - 7.6, 0.1);
  EXPECT_THAT(figure.finding, HasSubstr("by −7.60 N·m at most, after"));
  // MuJoCo's drawing leaves nothing behind that another figure would show
  EXPECT_EQ(DrawFigure(figure).image.pixels, drawn.image.pixels);
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
  const SimulationView view = ExampleSimulation();
  for (const SimulationFigure& one : SimulationFigures()) {
    const auto figure = one.make(view);
    if (figure) {
      EXPECT_EQ(figure->name, one.name);
      DrawLight(*figure);
    }
    EXPECT_FALSE(one.summary.empty());
  }
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
  try {
    MakeGlContext();
    FAIL() << "accepted";
  } catch (const BadInput& refusal) {
    EXPECT_THAT(refusal.what(), HasSubstr("WARMJOINT_GL: unknown value 'osmessa'; did you mean"));
  }
}

}  // namespace
}  // namespace warmjoint::report
