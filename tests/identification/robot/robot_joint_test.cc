// The fit of a joint whose rigid torque is given and may be wrong, on columns made of a known truth.
#include "identification/robot/robot_joint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "identification/robot/common_columns.h"
#include "identification/robot/report_joint.h"
#include "identification/robot/shared_directions.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// A truth, in N.m, s and rad.
struct JointTruth {
  double viscous = 2, forwards = 5, backwards = 4, load = .05, rotor = .8, gain = 1;
  double thermal_gain = 0, tau = 100;
};

/// 20 minutes of a joint at 10 Hz: gravity and inertia of a description that is wrong by z in four directions; without z by one deviation.
JointColumns Columns(const JointTruth& truth, unsigned seed, const VectorXd& given = {}) {
  constexpr Index n = 12000;
  constexpr double h = .1, noise = .3;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  JointColumns c;
  c.joint = "elbow";
  c.step = h;
  c.samples.time = VectorXd::LinSpaced(n, 0, h * (n - 1));
  const Eigen::ArrayXd t = c.samples.time.array();
  c.position = 1.2 * (.31 * t).sin() + .5 * (.83 * t + 1).sin();
  c.velocity = 1.2 * .31 * (.31 * t).cos() + .5 * .83 * (.83 * t + 1).cos();
  c.acceleration = -1.2 * .31 * .31 * (.31 * t).sin() - .5 * .83 * .83 * (.83 * t + 1).sin();
  c.sign = c.velocity.array().sign();
  c.forwards = (c.velocity.array() > 0).cast<double>();
  c.backwards = (c.velocity.array() < 0).cast<double>();
  c.top_speed = c.velocity.cwiseAbs().maxCoeff();
  c.slow.resize(n, std::ssize(kSlowShares));
  for (Index k = 0; k < c.slow.cols(); ++k) {
    const double bend = kSlowShares.at(static_cast<std::size_t>(k)) * c.top_speed;
    c.slow.col(k) = (-(c.velocity.array() / bend).square()).exp() * c.sign.array();
  }
  c.ripple.resize(n, 0);
  const Eigen::ArrayXd q = c.position.array();
  Eigen::MatrixXd directions(n, 4);
  directions << q.sin().matrix(), q.cos().matrix(), (.7 * q).sin().matrix(), c.acceleration;
  c.rigid = {20 * q.sin().matrix() + 2 * c.acceleration, directions};
  Eigen::MatrixXd carried = directions;
  carried.col(3).setZero();
  c.carried = {20 * q.sin().matrix(), carried};

  // the log of a robot that is not as described
  VectorXd z = given;
  if (z.size() == 0) z = VectorXd::NullaryExpr(4, [&] { return normal(random); });
  const VectorXd rigid = c.rigid.At({0, n}, z), load = c.carried.At({0, n}, z);
  c.samples.torque.resize(n);
  double energy = 0;
  const double pole = std::exp(-h / truth.tau);
  for (Index i = 0; i < n; ++i) {
    const double s = c.sign[i], v = c.velocity[i];
    const double level = truth.viscous * std::abs(v) + (s > 0 ? truth.forwards : truth.backwards) +
                         truth.load * std::abs(load[i]);
    const double friction = s * std::max(level + energy, 0.0);
    c.samples.torque[i] =
        truth.gain * rigid[i] + truth.rotor * c.acceleration[i] + friction + noise * normal(random);
    energy = pole * energy + (1 - pole) * truth.thermal_gain * std::abs(v) * (level + energy);
  }
  c.samples.keep = c.velocity.array().abs() > .02 * c.top_speed;
  return c;
}

JointFit Fit(const JointColumns& c, bool warms = false) {
  JointQuestion question;
  question.warms = warms;
  question.slows = false;
  return FitJoint(c, GuessGain(c), question);
}

/// By how many deviations a value is off.
double Off(const JointFit& fit, Index row, double truth) {
  return (fit.Value(row) - truth) / fit.Deviation(row);
}

TEST(RobotJoint, HoldsTheTruthWithinItsErrors) {
  // 20 logs: squares of deviations of each parameter from the truth are chi-squared of 20, 45.3 by chance in 1 of 1000
  const JointTruth truth;
  VectorXd squares = VectorXd::Zero(5);
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const JointColumns c = Columns(truth, seed);
    const JointFit fit = Fit(c);
    const Index law = fit.At(Role::law).begin;
    const VectorXd off{{Off(fit, law, truth.viscous), Off(fit, law + 1, truth.forwards),
                        Off(fit, law + 2, truth.backwards),
                        Off(fit, fit.At(Role::load).begin, truth.load),
                        Off(fit, fit.At(Role::scale).begin, std::log(truth.gain))}};
    squares += off.cwiseAbs2();
  }
  EXPECT_LT(squares.maxCoeff(), 45.3) << squares.transpose();
}

TEST(RobotJoint, TellsAnOffsetOfTheTorqueFromFriction) {
  // one that is smaller than the friction, and one that leaves none of it in one direction
  JointTruth truth;
  truth.backwards = 5.4;
  EXPECT_FALSE(Fit(Columns(truth, 1)).Has(Role::offset));
  for (const double offset : {3.0, -7.0}) {
    double squares = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
      JointColumns c = Columns(truth, seed);
      c.samples.torque.array() += offset;
      const JointFit fit = Fit(c);
      ASSERT_TRUE(fit.Has(Role::offset)) << offset << ", seed " << seed;
      EXPECT_TRUE(fit.beyond.empty());
      const Index law = fit.At(Role::law).begin;
      EXPECT_LT(std::abs(Off(fit, fit.At(Role::offset).begin, offset)), 4) << seed;
      EXPECT_LT(std::abs(Off(fit, law + 1, truth.forwards)), 4) << seed;
      EXPECT_LT(std::abs(Off(fit, law + 2, truth.backwards)), 4) << seed;
      EXPECT_LT(fit.Deviation(law + 1), .1 * truth.forwards);
      squares += std::pow(Off(fit, law, truth.viscous), 2);
    }
    EXPECT_LT(squares, 45.3) << "chi-squared of 20";
  }
}

TEST(RobotJoint, FindsWarmingWhereItIsAndNotWhereItIsNot) {
  JointTruth truth;
  EXPECT_FALSE(Fit(Columns(truth, 5), true).model.heat);
  truth.thermal_gain = -.5;
  const JointFit fit = Fit(Columns(truth, 5), true);
  ASSERT_TRUE(fit.model.heat);
  EXPECT_LT(std::abs(Off(fit, fit.At(Role::gain).begin, truth.thermal_gain)), 4);
  EXPECT_LT(std::abs(Off(fit, fit.At(Role::gain).begin + 1, std::log(truth.tau))), 4);
}

TEST(RobotJoint, DoesNotTakeFrictionThatFollowsTheMotionForWarming) {
  // friction of 5 N.m that falls by half with the speed's mean square over 2 s: a fifteenth of what the shortest of 20 minutes' time constants is
  JointColumns c = Columns({}, 6);
  double mean = 0;
  for (Index i = 0; i < c.velocity.size(); ++i) {
    c.samples.torque[i] -= c.sign[i] * 2.5 * mean / (c.top_speed * c.top_speed);
    mean += c.step / 2 * (c.velocity[i] * c.velocity[i] - mean);
  }
  EXPECT_FALSE(Fit(c, true).model.heat);
}

/// The fit with fields.
JointFit FitToFields(const JointColumns& c, bool warms = false) {
  JointQuestion question;
  question.warms = warms;
  question.slows = false;
  question.fields = FieldSet::All();
  return FitJoint(c, GuessGain(c), question);
}

TEST(RobotJoint, FieldsHoldWhatReturnsAtEachPlace) {
  // friction that ripples by a tenth over the angle; its mean over the places is part of both levels
  const JointTruth truth;
  VectorXd squares = VectorXd::Zero(3);
  int of_plain = 0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    JointColumns c = Columns(truth, seed);
    const VectorXd ripple = .5 * (9 * c.position.array() + seed).sin();
    c.samples.torque += ripple.cwiseProduct(c.sign);
    const double mean = c.samples.keep.select(ripple.array(), 0).sum() /
                        static_cast<double>(c.samples.keep.count());
    const auto off = [&](const JointFit& fit) {
      const Index law = fit.At(Role::law).begin;
      return VectorXd{{Off(fit, law, truth.viscous), Off(fit, law + 1, truth.forwards + mean),
                       Off(fit, law + 2, truth.backwards + mean)}};
    };
    squares += off(FitToFields(c)).cwiseAbs2();
    if (off(Fit(c)).cwiseAbs().maxCoeff() > 3) ++of_plain;
  }
  // 5 logs: chi-squared of 5, 20.5 by chance in 1 of 1000
  EXPECT_LT(squares.maxCoeff(), 20.5) << squares.transpose();
  EXPECT_GT(of_plain, 0);
}

TEST(RobotJoint, WithFieldsAWarmingIsFoundAndADriftIsNone) {
  JointTruth truth;
  truth.thermal_gain = -.5;
  const JointFit warm = FitToFields(Columns(truth, 5), true);
  ASSERT_TRUE(warm.model.heat);
  EXPECT_LT(std::abs(Off(warm, warm.At(Role::gain).begin, truth.thermal_gain)), 4);

  // a friction that wanders, which some logs show as a warming where there are no fields
  truth.thermal_gain = 0;
  int claimed = 0, without = 0;
  for (unsigned seed = 1; seed <= 40 && without < 2; ++seed) {
    JointColumns c = Columns(truth, seed);
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    double walk = 0;
    for (Index i = 0; i < c.sign.size(); ++i) {
      walk += .008 * normal(random);
      c.samples.torque[i] += walk * c.sign[i];
    }
    if (!Fit(c, true).model.heat) continue;
    ++without;
    claimed += FitToFields(c, true).model.heat ? 1 : 0;
  }
  EXPECT_EQ(without, 2);
  EXPECT_EQ(claimed, 0);
}

TEST(RobotJoint, WithFieldsPredictsWhatItHasNotSeen) {
  JointColumns c = Columns({}, 3);
  c.samples.torque.array() += (9 * c.position.array()).sin() * c.sign.array();
  const auto left = [&](const JointFit& fit) {
    return HoldOutJoint(fit, c, .4).held.metrics->rmse;
  };
  EXPECT_LT(left(FitToFields(c)), .6 * left(Fit(c)));
}

TEST(RobotJoint, JointsTogetherTellWhatTheDescriptionHasWrong) {
  // 10 logs of two joints that see the same directions: 40 squares, 73.4 by chance in 1 of 1000
  double squares = 0;
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const VectorXd z = VectorXd::NullaryExpr(4, [&] { return normal(random); });
    std::vector<JointColumns> columns{Columns({}, 2 * seed, z), Columns({}, 2 * seed + 1, z)};
    std::vector<JointFit> fits;
    for (const JointColumns& c : columns) fits.push_back(Fit(c));
    const SharedDirections shared = FitShared(fits, columns);
    EXPECT_TRUE(shared.converged);
    squares += (shared.z - z).cwiseAbs2().cwiseQuotient(shared.covariance.diagonal()).sum();
    // as sure as either alone at least
    for (const JointFit& fit : fits) {
      const Slice at = fit.At(Role::direction);
      const VectorXd alone = fit.uncertainty.covariance.diagonal().segment(at.begin, at.size);
      EXPECT_LT(shared.covariance.diagonal().sum(), 1.1 * alone.sum());
    }
  }
  EXPECT_LT(squares, 73.4);
}

TEST(RobotJoint, SaysByHowMuchADescriptionIsMoreWrongThanItsPrior) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  const VectorXd z = VectorXd::NullaryExpr(4, [&] { return normal(random) < 0 ? -6 : 6; });
  EXPECT_NEAR(Fit(Columns({}, 2, z)).description_error, 6, 2);
  // one that is as wrong as its prior has it says nothing
  for (unsigned seed = 1; seed <= 10; ++seed) {
    EXPECT_EQ(Fit(Columns({}, seed)).description_error, 1) << seed;
  }
}

TEST(RobotJoint, TellsATurnedTorque) {
  JointColumns c = Columns({}, 2);
  c.samples.torque = -c.samples.torque;
  EXPECT_LT(GuessGain(c).value, 0);
}

TEST(RobotJoint, IsReportedWithBothDirectionsAndTheirMean) {
  const JointColumns c = Columns({}, 4);
  const JointFit fit = Fit(c);
  const RobotJointEstimate answer = ReportJoint(fit, c, {}, HoldOutJoint(fit, c, .4));
  ASSERT_EQ(answer.estimate.status, Status::ok) << answer.estimate.message;
  EXPECT_TRUE(answer.HasFriction());
  EXPECT_NEAR(answer.estimate.Find("coulomb")->value, 4.5, .2);
  EXPECT_LT(*answer.summary.rms_held_out, .35);
  EXPECT_GT(*answer.summary.rms_without_friction, 2);
}

TEST(RobotJoint, WithLittleFrictionUnderMuchNoiseIsAsSureAsItsInterval) {
  // the noise is more than half of the friction, and much less than the weight
  const JointTruth truth{.viscous = .2, .forwards = .3, .backwards = .3, .load = 0, .rotor = 0};
  int held = 0, all = 0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const JointColumns c = Columns(truth, seed);
    const RobotJointEstimate answer = ReportJoint(Fit(c), c, {}, {});
    ASSERT_EQ(answer.estimate.status, Status::ok) << answer.estimate.message;
    for (const FrictionAtSpeed& at : answer.estimate.friction_at_speeds) {
      const double friction = truth.viscous * std::abs(at.speed) + truth.forwards;
      held += at.interval95[0] <= friction && friction <= at.interval95[1];
      ++all;
    }
  }
  // intervals of 95 %, six a log that are not independent
  EXPECT_GE(held, .8 * all);
}

TEST(RobotJoint, WhoseFrictionDoesNotReturnIsRefusedByWhatWasHeldOut) {
  JointColumns c = Columns({}, 4);
  const Index end = c.sign.size() * 4 / 10;
  c.samples.torque.tail(end) -= 10 * c.sign.tail(end);
  const JointFit fit = Fit(c);
  const RobotJointEstimate unseen = ReportJoint(fit, c, {}, HoldOutJoint(fit, c, 0));
  EXPECT_EQ(unseen.estimate.status, Status::ok) << unseen.estimate.message;
  EXPECT_FALSE(unseen.estimate.holdout);
  EXPECT_EQ(unseen.estimate.without_holdout, "");
  const RobotJointEstimate answer = ReportJoint(fit, c, {}, HoldOutJoint(fit, c, .4));
  EXPECT_EQ(answer.estimate.status, Status::inadequate_model);
  EXPECT_GT(*answer.summary.rms_held_out, *answer.summary.rms_without_friction);
}

TEST(RobotJoint, JointsTogetherTellADelay) {
  // three joints whose torques come late by two thirds of a step, and three that do not
  constexpr double late = .066;  // s
  Eigen::VectorXd off(10);
  for (const double delay : {0.0, late}) {
    int shown = 0;
    for (unsigned seed = 0; seed < off.size(); ++seed) {
      std::vector<JointColumns> joints;
      std::vector<GainGuess> guesses;
      for (unsigned j = 0; j < 3; ++j) {
        JointColumns c = Columns({}, 10 * seed + j);
        const Eigen::VectorXd torque = c.samples.torque;
        for (Index i = 1; i < torque.size(); ++i) {
          c.samples.torque[i] += delay / c.step * (torque[i - 1] - torque[i]);
        }
        c.samples.keep = c.velocity.array().abs() > .3 * c.top_speed;
        guesses.push_back(GuessGain(c));
        joints.push_back(std::move(c));
      }
      const CommonFit fit = FitDelay({&joints[0], &joints[1], &joints[2]}, guesses, 1);
      off[seed] = (fit.value[0] - delay) / std::sqrt(fit.covariance(0, 0));
      shown += fit.is_shown ? 1 : 0;
    }
    // chi-squared of ten: 30 by chance in 1 of 1000
    EXPECT_LT(off.squaredNorm(), 30) << off.transpose();
    EXPECT_EQ(shown, delay > 0 ? 10 : 0);
  }
}

TEST(RobotJoint, TheUnitTellsTheGainUnlessTheLogDoes) {
  const JointColumns c = Columns({}, 1);
  const auto spread = [&](double guess, double middle) {
    return PriorOfGain(c, {.value = guess, .deviations = 50}, middle).spread;
  };
  EXPECT_LT(spread(1.1, 1.2), .2);
  EXPECT_EQ(spread(.0125, 1), 1);
  // all on the motors' side
  EXPECT_NEAR(PriorOfGain(c, {.value = .0125, .deviations = 50}, .013).middle, .013, 1e-12);
  JointColumns current = c;
  current.torque_unit = "A";
  EXPECT_EQ(PriorOfGain(current, {.value = 1, .deviations = 50}, .2).middle, .2);
}

TEST(RobotJoint, IsRefusedWhereItMovesOneWayOrNotAtAll) {
  JointColumns c = Columns({}, 1);
  EXPECT_EQ(WhyNothing(c, 3), "");
  EXPECT_NE(WhyNothing(c, .01).find("did not move"), std::string::npos);
  c.samples.keep = c.samples.keep && c.velocity.array() > 0;
  EXPECT_NE(WhyNothing(c, 3).find("one direction"), std::string::npos);
}

}  // namespace
}  // namespace warmjoint
