// Joints that slide: against closed forms, and against what MuJoCo has of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/sim/plugin/friction_models.h"

namespace warmjoint {
namespace {

using namespace test;

TEST(PluginHeat, FollowsTheClosedFormAtConstantSpeedAtAnyStep) {
  // Table I, and a carriage: W = |F v| in W of N and m/s, too
  const struct {
    bool slides;
    double viscous, coulomb, k, tau, v;
  } joints[] = {{false, 5, 15, -3, 600, 0.5}, {true, 60, 40, -0.8, 300, 0.2}};
  for (const auto& [slides, viscous, coulomb, k, tau, v] : joints) {
    const Config config{{"law", "viscous_coulomb"},
                        {"viscous", fmt::format("{}", viscous)},
                        {"coulomb", fmt::format("{}", coulomb)},
                        {"thermal_gain", fmt::format("{}", k)},
                        {"thermal_time_constant", fmt::format("{}", tau)}};
    for (const double h : {0.0005, 0.002, 0.01}) {
      const std::string option = fmt::format(R"(timestep="{}" gravity="0 0 0")", h);
      const std::string xml = slides
                                  ? CarriageXml(FrictionSection(config, {.joint = "slide"}), option)
                                  : LinkXml(FrictionSection(config), option, R"(armature="2")");
      const Model m = MustCompile(xml);
      const Data d(mj_makeData(m.get()));
      const double level = viscous * v + coulomb;
      const double settled = k * v * level / (1 - k * v);       // E, N.m or N
      const double rate = -std::expm1(-h / tau) * (1 - k * v);  // 1 - (te + ke v)
      d->act[0] = coulomb;                                      // slides from the first step on
      for (int i = 1; i <= 20000; ++i) {
        d->qvel[0] = v;
        mj_step(m.get(), d.get());
        if (i % 5000 != 0) continue;
        const double closed = settled * -std::expm1(i * std::log1p(-rate));
        // the last bit of te is 1e-16, which is 1e-10 of 1 - te at the smallest step
        EXPECT_NEAR(d->act[1], closed, 1e-9 * std::abs(closed)) << "step " << h;
        EXPECT_NEAR(d->actuator_force[0], -(level + closed), rate * std::abs(settled));

        // the continuous form differs by h (1 - k v) / (2 tau) of the rate
        const double continuous = settled * -std::expm1(-i * h * (1 - k * v) / tau);
        EXPECT_NEAR(d->act[1], continuous, 2 * h / tau * std::abs(settled));
      }
    }
  }
}

/// Speeds of the link from a start in each of 1.2 s.
std::vector<double> Slowing(const std::string& sections, const std::string& joint, double start,
                            const std::string& option = kNoGravity) {
  const Model m = MustCompile(LinkXml(sections, option, joint));
  const Data d(mj_makeData(m.get()));
  d->qvel[0] = start;
  std::vector<double> speeds;
  for (int i = 0; i < 1200; ++i) {
    mj_step(m.get(), d.get());
    speeds.push_back(d->qvel[0]);
  }
  return speeds;
}

double LargestDifference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

TEST(PluginSliding, MovesAsNativeDampingAndFrictionlossDo) {
  // both explicit (eulerdamp off): rounding alone
  const auto viscous =
      FrictionSection({{"law", "viscous_coulomb"}, {"viscous", "2"}, {"coulomb", "0"}});
  EXPECT_LT(LargestDifference(Slowing(viscous, "", 3), Slowing("", R"(damping="2")", 3)), 1e-13);
  // 24 rad/s^2 stop the joint after 1.25 s; a saturated frictionloss is the same number
  const auto coulomb = FrictionSection({{"law", "coulomb"}, {"coulomb", "6"}});
  EXPECT_LT(LargestDifference(Slowing(coulomb, "", 30), Slowing("", R"(frictionloss="6")", 30)),
            5e-12);
}

TEST(PluginSliding, SlowsUnderRk4ByItsLevel) {
  const auto coulomb = FrictionSection({{"law", "coulomb"}, {"coulomb", "6"}});
  const auto speeds =
      Slowing(coulomb, "", 30, R"(timestep="0.001" integrator="RK4" gravity="0 0 0")");
  // a second of 6 N.m on 0.25 kg.m^2 and the inertial's 1e-9
  EXPECT_NEAR(speeds[1000], speeds[0] - 6 / (0.25 + 1e-9), 1e-10);
}

const Config kLugre{{"law", "lugre"},
                    {"viscous", "0"},
                    {"coulomb", "3"},
                    {"static", "4"},
                    {"stribeck_velocity", "0.1"},
                    {"bristle_stiffness", "2000"},
                    {"bristle_damping", "8"}};

constexpr char kDcMotor[] =
    R"(<actuator><dcmotor joint="hinge" input="none" motorconst="0 0" resistance="1"
                          lugre="2000 8 3 4 0.1"/></actuator>)";

/// Velocities under a torque that slides the link to and fro, each 10 ms of 2 s.
std::vector<double> Course(const std::string& section, double h) {
  const Model m = MustCompile(LinkXml(section, fmt::format(R"(timestep="{}" gravity="0 0 0")", h)));
  const Data d(mj_makeData(m.get()));
  std::vector<double> trajectory;
  const long stride = std::lround(0.01 / h);
  for (long i = 0; i < 200 * stride; ++i) {
    d->qfrc_applied[0] = 6 * std::sin(2 * static_cast<double>(i) * h);
    mj_step(m.get(), d.get());
    if (i % stride == stride - 1) trajectory.push_back(d->qvel[0]);
  }
  return trajectory;
}

TEST(PluginLugre, MovesAsTheDcMotorsLugreDoesUpToTheErrorOfTheStep) {
  // both are first order in the step: each is off the common limit by twice its change from h to
  // h/2, a third time for the higher orders, so that they differ by no more than both together
  const double h = 0.0005;
  const auto ours = Course(FrictionSection(kLugre), h);
  const auto native = Course(kDcMotor, h);
  const double our_error = 3 * LargestDifference(ours, Course(FrictionSection(kLugre), h / 2));
  const double native_error = 3 * LargestDifference(native, Course(kDcMotor, h / 2));
  const double difference = LargestDifference(ours, native);
  const double fastest = std::abs(*std::max_element(
      ours.begin(), ours.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  EXPECT_LE(difference, our_error + native_error);
  // and the bound is small
  EXPECT_LT(our_error + native_error, 0.02 * fastest);
  EXPECT_GT(fastest, 1);
}

TEST(PluginStribeck, SlidesAsTheClosedFormOfItsSteadyForce) {
  // v' = -g(v) / M without drive, by classical Runge-Kutta at a twentieth of the step
  const Config stribeck{{"law", "stribeck"},
                        {"viscous", "0.5"},
                        {"coulomb", "3"},
                        {"static", "4"},
                        {"stribeck_velocity", "2"}};
  const double h = 0.0001, mass = 0.25;
  const Model m =
      MustCompile(LinkXml(FrictionSection(stribeck), R"(timestep="0.0001" gravity="0 0 0")"));
  const Data d(mj_makeData(m.get()));
  d->qvel[0] = 8;
  d->act[0] = 4;
  const auto rate = [&](double v) { return -(0.5 * v + 3 + std::exp(-v * v / 4)) / mass; };
  double v = 8;
  for (int i = 0; i < 3000; ++i) {
    for (int k = 0; k < 20; ++k) {
      const double s = h / 20, k1 = rate(v), k2 = rate(v + s / 2 * k1);
      const double k3 = rate(v + s / 2 * k2), k4 = rate(v + s * k3);
      v += s / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    mj_step(m.get(), d.get());
    // Euler: h/2 times the integral of |v''| over 0.3 s, v'' = rate' rate, |rate| <= 28, |rate'| <=
    // 2
    ASSERT_NEAR(d->qvel[0], v, 0.5 * h * 56 * 0.3) << i;
  }
  EXPECT_GT(v, 0.5);
}

}  // namespace
}  // namespace warmjoint
