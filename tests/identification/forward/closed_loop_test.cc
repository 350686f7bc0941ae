#include "identification/forward/closed_loop.h"

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "identification/forward/log_trajectory.h"
#include "identification/forward/thermal_filter.h"
#include "identification/linear/linear_laws.h"
#include "identification/warming/thermal_fit.h"
#include "models/friction/along_motion.h"
#include "models/friction/laws.h"
#include "tests/support/golden.h"
#include "tests/support/vectors.h"
#include "tests/support/warm_recording.h"

namespace warmjoint {
namespace {

constexpr double kStep = 1;  // s

Eigen::VectorXd EvenTime(Eigen::Index n, double h = kStep) {
  return Eigen::VectorXd::LinSpaced(n, 0, h * static_cast<double>(n - 1));
}

LawBlocks Blocks(const Eigen::VectorXd& time, const Eigen::VectorXd& velocity) {
  const Eigen::MatrixXd columns = LawColumns(*FindLaw("viscous_coulomb"), velocity);
  return {ClosedLoop(time, velocity, columns), columns};
}

ClosedLoop Loop(const Eigen::VectorXd& time, const Eigen::VectorXd& velocity) {
  return ClosedLoop(time, velocity, LawColumns(*FindLaw("viscous_coulomb"), velocity));
}

/// Each entry within `tolerance`, relative to the largest.
void ExpectNear(const Eigen::MatrixXd& actual, const Eigen::MatrixXd& expected, double tolerance) {
  ASSERT_EQ(actual.rows(), expected.rows());
  ASSERT_EQ(actual.cols(), expected.cols());
  EXPECT_LE((actual - expected).cwiseAbs().maxCoeff(), tolerance * expected.cwiseAbs().maxCoeff())
      << actual << "\n\n"
      << expected;
}

TEST(ClosedLoop, ReproducesTheGoldenSimulation) {
  const nlohmann::json& golden = test::Golden().at("closed_sim");
  const Eigen::VectorXd v = test::ToVector(golden.at("v"));
  const Eigen::Vector2d p(golden.at("kv"), golden.at("kc"));
  const Thermal thermal = Continuous(DiscreteThermal{golden.at("ke"), golden.at("te")}, kStep);
  const ClosedLoop loop = Loop(EvenTime(v.size()), v);
  const LoopResponse response = loop.Simulate(p, thermal, golden.at("E0"));

  // 1e-12: a recursion of ten closed forms
  ExpectNear(response.force, test::ToVector(golden.at("F")), 1e-12);
  ExpectNear(response.loss, test::ToVector(golden.at("W")), 1e-12);
  ExpectNear(response.energy, test::ToVector(golden.at("E")), 1e-12);
  EXPECT_FALSE(response.first_driving);
  const Eigen::MatrixXd jacobian =
      WarmJacobian(Blocks(EvenTime(v.size()), v), p, thermal, golden.at("E0"));
  ExpectNear(ByDiscretePair(jacobian, thermal, kStep),
             test::ToMatrix(golden.at("dF_dkv_dkc_dke_dte_dE0")), 1e-12);
}

TEST(ClosedLoop, WarmsAtConstantSpeedAsTheClosedForm) {
  const nlohmann::json& golden = test::Golden().at("constant_speed");
  const double v = golden.at("v");
  const Thermal thermal = Continuous(DiscreteThermal{golden.at("ke"), golden.at("te")}, kStep);
  const Eigen::VectorXd velocity = Eigen::VectorXd::Constant(3601, v);
  const LoopResponse response =
      Loop(EvenTime(3601), velocity).Simulate(Eigen::Vector2d(5, 15), thermal);
  const std::vector<int> samples = golden.at("k");
  const Eigen::VectorXd expected = test::ToVector(golden.at("E_closed"));

  // 1e-12 times the settled level: 3600 steps of rounding on both sides
  for (size_t i = 0; i < samples.size(); ++i) {
    EXPECT_NEAR(response.energy[samples[i]], expected[i], 1e-12 * 10.5) << samples[i];
  }
}

/// F at the last sample by the models' own functions; parameters: kv, kc, k, tau, E0.
template <typename T>
T LastForce(const Eigen::VectorXd& time, const Eigen::VectorXd& v, const std::array<T, 5>& p) {
  T energy = p[4];
  for (Eigen::Index n = 0;; ++n) {
    const T force = WarmForce(v[n], ViscousCoulomb::Force(v[n], p.data()), energy);
    if (n == v.size() - 1) return force;
    using std::exp;
    const T pole = exp(-(time[n + 1] - time[n]) / p[3]);
    energy = ThermalStep(T(p[2] * (1.0 - pole)), pole, energy, Loss(v[n], force));
  }
}

TEST(ClosedLoop, AgreesWithDualNumbersOnUnevenSamples) {
  const Eigen::VectorXd time = (Eigen::VectorXd(8) << 0, 1, 1.5, 4, 4.1, 9, 10, 20).finished();
  const Eigen::VectorXd v =
      (Eigen::VectorXd(8) << 0.5, -0.2, -0.8, 0, 0.9, 0.4, -0.7, 0.3).finished();
  using Jet = ceres::Jet<double, 5>;
  const std::array<Jet, 5> p{Jet(5, 0), Jet(15, 1), Jet(-3, 2), Jet(7, 3), Jet(-0.5, 4)};
  const ClosedLoop loop = Loop(time, v);
  const Thermal thermal{-3, 7};

  // 1e-12: rounding, the Jet's pole loses digits in 1 - exp
  for (Eigen::Index last = 0; last < time.size(); ++last) {
    const Jet force = LastForce(time, v.head(last + 1), p);
    const Eigen::MatrixXd jacobian =
        WarmJacobian(Blocks(time, v), Eigen::Vector2d(5, 15), thermal, -0.5);
    EXPECT_NEAR(loop.Simulate(Eigen::Vector2d(5, 15), thermal, -0.5).force[last], force.a, 1e-12);
    ExpectNear(jacobian.row(last), force.v.transpose(), v[last] == 0 ? 0 : 1e-12);
  }
}

TEST(ClosedLoop, IsTheForwardModelWithJumpsAndColdStarts) {
  const Eigen::VectorXd time =
      (Eigen::VectorXd(10) << 0, 1, 1.5, 4, 4.1, 9, 10, 20, 21, 22).finished();
  const Eigen::VectorXd v =
      (Eigen::VectorXd(10) << 0.5, -0.2, -0.8, 0, 0.9, 0.4, -0.7, 0.3, 0.6, -0.6).finished();
  const Friction friction{"viscous_coulomb", {{"viscous", 5}, {"coulomb", 15}}, Thermal{-0.8, 7}};
  const ClosedLoop loop = ClosedLoop(time, v, LawColumns(*FindLaw("viscous_coulomb"), v), {6});
  const LoopResponse response = loop.Simulate(Eigen::Vector2d(5, 15), *friction.thermal, -0.5,
                                              {{2, 8}, Eigen::Vector2d(0.3, -0.2)});
  JointTrajectory trajectory{time, v};
  trajectory.starts = {6};
  const Prediction p = AlongMotion(friction).Predict(trajectory, {-0.5, 0, {{2, 0.3}, {8, -0.2}}});
  // lambda E + feedback g against te E + ke W: rounding of ten steps
  ExpectNear(response.force, p.force, 1e-14);
  ExpectNear(response.loss, p.loss, 1e-14);
  ExpectNear(response.energy, p.energy, 1e-14);
}

TEST(ClosedLoop, LosesByTheMeansBetweenSamplesAsTheForwardModel) {
  // an asymmetric law, so that levels and losses differ by side and speed
  LogSamples m;
  m.time = (Eigen::VectorXd(7) << 0, 1, 2.5, 3, 4, 6, 7).finished();
  m.velocity = (Eigen::VectorXd(7) << 0.5, 0.1, -0.8, 0, 0.9, 0.4, -0.7).finished();
  m.mean_speed = (Eigen::VectorXd(7) << 0.3, 0.4, 0.4, 0, 0.7, 0.3, 0.7).finished();
  m.loss_velocity = (Eigen::VectorXd(7) << 0.35, 0.6, -0.5, 0, 0.72, 0.4, -0.7).finished();
  const Law& law = *FindLaw("asymmetric");
  const ClosedLoop loop = ClosedLoop::Along(m, LawColumns(law, m.velocity), LossColumns(law, m));
  const Eigen::Vector3d p(5, 15, 12);
  const Thermal thermal{-0.8, 7};

  // rounding of seven steps
  const Friction friction{
      "asymmetric",
      {{"viscous", p[0]}, {"coulomb_positive", p[1]}, {"coulomb_negative", p[2]}},
      thermal};
  const LoopResponse response = loop.Simulate(p, thermal, -0.5);
  m.position = m.torque = Eigen::VectorXd::Zero(7);
  const Prediction predicted = PredictFriction(friction, m, {-0.5});
  ExpectNear(response.force, predicted.force, 1e-14);
  ExpectNear(response.loss, predicted.loss, 1e-14);
  ExpectNear(response.energy, predicted.energy, 1e-14);

  // central differences: the error is of order step^2 = 1e-10
  Eigen::VectorXd x(6);
  x << p, thermal.gain, thermal.time_constant, -0.5;
  Eigen::MatrixXd differences(7, 6);
  for (int i = 0; i < 6; ++i) {
    const auto force = [&](double step) {
      Eigen::VectorXd at = x;
      at[i] += step;
      return loop.Simulate(at.head(3), {at[3], at[4]}, at[5]).force;
    };
    const double step = 1e-5 * std::abs(x[i]);
    differences.col(i) = (force(step) - force(-step)) / (2 * step);
  }
  const LawBlocks blocks(m, LawColumns(law, m.velocity), LossColumns(law, m),
                         Eigen::MatrixXd(7, 0));
  ExpectNear(WarmJacobian(blocks, p, thermal, -0.5), differences, 1e-8);
}

TEST(ThermalFilter, FollowsTheGoldenFilterFromItsInitialEnergy) {
  const auto& golden = test::Golden()["filter"];
  const double h = 0.5;
  const Thermal thermal = Continuous({golden["ke"], golden["te"]}, h);

  const Eigen::VectorXd energy =
      ThermalFilter(EvenTime(8, h)).Energy(thermal, test::ToVector(golden["W"]), golden["E0"]);
  // 1e-12: closed form, through one logarithm and back
  EXPECT_LT((energy - test::ToVector(golden["E"])).norm(), 1e-12 * energy.norm());
}

TEST(ThermalFilter, SensitivitiesAreTheGoldenOnesByTheChainRule) {
  const auto& golden = test::Golden()["oe_sens"];
  const double ke = golden["ke"], te = golden["te"], h = 2;
  const double tau = Continuous({ke, te}, h).time_constant;
  const Eigen::VectorXd loss = test::ToVector(golden["W"]);
  const ThermalFilter filter(EvenTime(8, h));
  const Eigen::VectorXd initial = filter.Energy({0, tau}, Eigen::VectorXd::Zero(8), 1);  // dE/dE(0)

  filter.ForEach(tau, loss, [&](Eigen::Index i, const UnitEnergy& S) {
    const auto& row = golden["dE_dke_dte_dE0"][static_cast<size_t>(i)];
    // E = ke S / (1 - te) + te^i E(0), and dte/dtheta = te h/tau
    const double by_gain = S.value / (1 - te);
    const double by_pole =
        ke * S.value / ((1 - te) * (1 - te)) + ke / (1 - te) * S.slope / (te * h / tau) +
        (i > 0 ? static_cast<double>(i) * std::pow(te, i - 1) : 0.0) * golden["E0"].get<double>();
    // 1e-12: closed form; entries are of order 1
    EXPECT_NEAR(by_gain, row[0].get<double>(), 1e-12 * 10) << i;
    EXPECT_NEAR(by_pole, row[1].get<double>(), 1e-12 * 10) << i;
    EXPECT_NEAR(initial[i], row[2].get<double>(), 1e-12) << i;
  });
}

TEST(ThermalFilter, UnevenStepsAgreeWithAFineEvenGrid) {
  // losses change only on a grid of 4 s; the coarse times are a subset of the fine ones
  const Eigen::VectorXd fine_time = EvenTime(81, 0.5);
  Eigen::VectorXd fine_loss(81);
  for (Eigen::Index i = 0; i < 81; ++i) fine_loss[i] = static_cast<double>((i / 8) % 3);
  std::vector<Eigen::Index> taken;
  for (Eigen::Index i = 0; i < 81; ++i) {
    if (i % 8 == 0 || i % 5 == 0) taken.push_back(i);
  }

  const Thermal thermal{-2, 9};
  const Eigen::VectorXd fine = ThermalFilter(fine_time).Energy(thermal, fine_loss);
  const Eigen::VectorXd coarse = ThermalFilter(fine_time(taken)).Energy(thermal, fine_loss(taken));
  // both are exact: 1e-12 for closed forms
  EXPECT_LT((coarse - fine(taken)).norm(), 1e-12 * fine.norm());
}

TEST(PredictFriction, FollowsTheGoldenClosedLoop) {
  const nlohmann::json& golden = test::Golden().at("closed_sim");
  const double h = 0.25;
  const Thermal thermal = Continuous({golden.at("ke"), golden.at("te")}, h);
  const Friction friction{
      "viscous_coulomb", {{"viscous", golden.at("kv")}, {"coulomb", golden.at("kc")}}, thermal};
  const Eigen::VectorXd velocity = test::ToVector(golden.at("v"));
  const Measurements motion = test::Record(h, velocity, 0 * velocity);

  const Prediction prediction = PredictFriction(friction, LogSamples(motion), {golden.at("E0")});
  // 1e-12: closed form, through one logarithm and back
  const Eigen::VectorXd force = test::ToVector(golden.at("F"));
  EXPECT_LT((prediction.force - force).norm(), 1e-12 * force.norm());
  const Eigen::VectorXd energy = test::ToVector(golden.at("E"));
  EXPECT_LT((prediction.energy - energy).norm(), 1e-12 * energy.norm());
  EXPECT_EQ(prediction.first_driving, motion.size());
}

TEST(PredictFriction, HoldsTheNominalLawWhereNothingWarms) {
  Friction friction = test::TableOne();
  friction.thermal.reset();
  const Eigen::VectorXd velocity = test::AlternatingSpeeds(100, 1, 30);
  const Prediction prediction =
      PredictFriction(friction, LogSamples(test::Record(1, velocity, 0 * velocity)));
  for (Eigen::Index i = 0; i < 100; ++i) {
    EXPECT_DOUBLE_EQ(prediction.force[i], 5 * velocity[i] + 15 * Sign(velocity[i]));
  }
}

TEST(PredictFriction, CoolsThroughAGapInTime) {
  Measurements motion = test::Record(1, Eigen::VectorXd::Zero(5), Eigen::VectorXd::Zero(5));
  motion.time << 0, 1, 2, 602, 603;
  const Prediction prediction = PredictFriction(test::TableOne(), LogSamples(motion), {-8});
  // 1e-12: closed form
  EXPECT_NEAR(prediction.energy[3], -8 * std::exp(-602.0 / 600), 8e-12);
}

TEST(PredictFriction, BendsTheBristleAsTheTorqueTells) {
  // 1 s at 0.001 rad/s: the bristle of 2000 N.m/rad takes up 2 N.m on the way, from 3 N.m on
  const Friction friction{"dahl", {{"coulomb", 15}, {"bristle_stiffness", 2000}}, {}};
  Measurements m =
      test::Record(0.01, Eigen::VectorXd::Constant(101, 0.001), Eigen::VectorXd::Zero(101));
  m.torque[0] = 3;
  const Eigen::VectorXd sliding = PredictFriction(friction, LogSamples(m)).force;
  EXPECT_NEAR(sliding[0], 15, 1e-9);
  EXPECT_NEAR(sliding[100], 15, 1e-9);
  const Eigen::VectorXd bent =
      PredictFriction(friction, LogSamples(m), {}, BristleStart::torque).force;
  EXPECT_NEAR(bent[0], 3, 1e-9);
  // ds/dx = sigma0 (1 - s/15)
  EXPECT_NEAR(bent[100], 15 - 12 * std::exp(-2000 * 0.001 / 15), 1e-9);
}

}  // namespace
}  // namespace warmjoint
