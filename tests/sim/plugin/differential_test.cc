// Ours beside what MuJoCo has of its own: LuGre of dcmotor.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/sim/plugin/friction_models.h"

namespace warmjoint {
namespace {

using namespace test;

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
  std::vector<double> course;
  const long stride = std::lround(0.01 / h);
  for (long i = 0; i < 200 * stride; ++i) {
    d->qfrc_applied[0] = 6 * std::sin(2 * static_cast<double>(i) * h);
    mj_step(m.get(), d.get());
    if (i % stride == stride - 1) course.push_back(d->qvel[0]);
  }
  return course;
}

double LargestDifference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
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
