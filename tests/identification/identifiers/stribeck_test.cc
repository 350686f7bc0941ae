#include <gmock/gmock.h>

#include <cmath>

#include "identification/nonlinear/stribeck_fit.h"
#include "identification/preparation/select.h"
#include "tests/support/judging.h"
#include "tests/support/slow_recording.h"

namespace warmjoint {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

Estimate AnswerTo(const Measurements& m, const std::map<std::string, std::string>& given = {}) {
  return test::Fitted("stribeck", m, given);
}

using test::StribeckJoint;

const std::map<std::string, double> kTruth{
    {"viscous", 5}, {"coulomb", 15}, {"static", 20}, {"stribeck_velocity", 0.05}};

/// What of a friction is estimated: its law but for the exponent, and its warming.
std::map<std::string, double> TruthOf(const Friction& friction) {
  std::map<std::string, double> truth = friction.parameters;
  truth.erase("stribeck_exponent");
  if (!friction.thermal) return truth;
  truth["thermal_gain"] = friction.thermal->gain;
  truth["thermal_time_constant"] = friction.thermal->time_constant;
  return truth;
}

/// Of 40 realizations, how often each interval holds the truth. n: samples at 0.1 s; noise: N.m.
std::map<std::string, int> CountHeld(const Friction& joint, Eigen::Index n, double noise) {
  const std::map<std::string, std::string> given{{"law", joint.law},
                                                 {"warming", joint.thermal ? "estimated" : "none"}};
  std::map<std::string, int> held;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Estimate estimate =
        AnswerTo(test::RecordFriction(joint, 0.1, test::SlowAndFast(n, seed), noise, seed), given);
    EXPECT_EQ(estimate.status, Status::ok) << estimate.message;
    if (estimate.status != Status::ok) continue;
    for (const auto& [name, truth] : TruthOf(joint)) {
      const auto& [lower, upper] = *estimate.Find(name)->interval95;
      held[name] += lower <= truth && truth <= upper;
    }
  }
  return held;
}

// 38 of 40 expected, binomial deviation 1.4; four of them
constexpr int kHeld = 32;

TEST(Stribeck, HoldsTheTruthInItsIntervals) {
  const auto held = CountHeld(StribeckJoint(), 4000, 0.5);
  EXPECT_EQ(held.size(), 4u);
  for (const auto& [name, count] : held) EXPECT_GE(count, kHeld) << name;
}

TEST(Stribeck, HoldsTwoLevelsInItsIntervals) {
  const auto held = CountHeld(test::TwoLevelStribeckJoint(), 4000, 0.5);
  EXPECT_EQ(held.size(), 5u);
  for (const auto& [name, count] : held) EXPECT_GE(count, kHeld) << name;
}

TEST(Stribeck, HoldsTwoLevelsAndTheirWarmingInItsIntervals) {
  Friction warm = test::TwoLevelStribeckJoint();
  warm.thermal = Thermal{-3, 60};
  const auto held = CountHeld(warm, 4000, 0.5);
  EXPECT_EQ(held.size(), 7u);
  for (const auto& [name, count] : held) EXPECT_GE(count, kHeld) << name;
}

TEST(Stribeck, FindsTwoLevelsExactlyWhereThereIsNoNoise) {
  Friction joint = test::TwoLevelStribeckJoint();
  for (const bool warms : {false, true}) {
    if (warms) joint.thermal = Thermal{-3, 60};
    const Estimate estimate =
        AnswerTo(test::RecordFriction(joint, 0.1, test::SlowAndFast(2000, 5), 0, 5),
                 {{"law", joint.law}, {"warming", warms ? "estimated" : "none"}});
    ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
    // iterative optimisers (golden/README)
    for (const auto& [name, truth] : TruthOf(joint)) {
      EXPECT_NEAR(estimate.Find(name)->value, truth, 1e-6 * std::abs(truth)) << name;
    }
  }
}

TEST(Stribeck, SaysThatOneDirectionCannotTellTwoLevels) {
  const Eigen::VectorXd forwards = test::SlowAndFast(4000, 7).cwiseAbs();
  const Estimate estimate =
      AnswerTo(test::RecordFriction(test::TwoLevelStribeckJoint(), 0.1, forwards, 0.5, 7),
               {{"law", "asymmetric_stribeck"}});
  EXPECT_EQ(estimate.status, Status::not_identifiable);
  EXPECT_THAT(estimate.message,
              AllOf(HasSubstr("coulomb_negative"), HasSubstr("in both directions")));
}

TEST(Stribeck, FindsTheWarmingToo) {
  Friction warm = StribeckJoint();
  warm.thermal = Thermal{-3, 60};
  const Measurements m = test::RecordFriction(warm, 0.1, test::SlowAndFast(6000, 3), 0.3, 3);
  const Estimate estimate = AnswerTo(m, {{"warming", "estimated"}});
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  ASSERT_TRUE(estimate.friction && estimate.friction->thermal);
  for (const auto& [name, truth] : kTruth) {
    const EstimatedParameter& parameter = *estimate.Find(name);
    EXPECT_NEAR(parameter.value, truth, 5 * *parameter.std) << name;
  }
  EXPECT_NEAR(estimate.Find("thermal_gain")->value, -3, 5 * *estimate.Find("thermal_gain")->std);
  EXPECT_NEAR(estimate.Find("thermal_time_constant")->value, 60,
              5 * *estimate.Find("thermal_time_constant")->std);
  EXPECT_NEAR(estimate.metrics->rmse, 0.3, 0.3 * 5 / std::sqrt(2 * 6000.0));
}

TEST(Stribeck, TakesEachOfSeveralRecordingsFromCold) {
  // the same warm-up twice tells what it tells once, a root of two more surely
  Friction warm = StribeckJoint();
  warm.thermal = Thermal{-3, 60};
  const Measurements once = test::RecordFriction(warm, 0.1, test::SlowAndFast(4000, 3), 0.3, 3);
  const Estimate one = AnswerTo(once, {{"warming", "estimated"}});
  const Estimate two =
      test::Fitted("stribeck", Prepare(std::vector{once, once}), {{"warming", "estimated"}});
  ASSERT_EQ(one.status, Status::ok) << one.message;
  ASSERT_EQ(two.status, Status::ok) << two.message;
  for (const EstimatedParameter& parameter : one.parameters) {
    const EstimatedParameter& other = *two.Find(parameter.name);
    // 1e-6: iterative optimisers (golden/README)
    EXPECT_NEAR(other.value, parameter.value, 1e-6 * std::abs(parameter.value)) << parameter.name;
    if (!parameter.std) continue;
    // white noise over n - 6 and 2 n - 6 freedoms: one in 4000
    EXPECT_NEAR(*other.std, *parameter.std / std::sqrt(2), 1e-3 * *parameter.std) << parameter.name;
  }
}

TEST(Stribeck, NamesWhatNeedsSlowSpeedsAndTheMotionThatHelps) {
  // nothing below 0.2 rad/s, four times vs: exp(-16) of the fall is left
  Eigen::VectorXd velocity = test::SlowAndFast(4000, 7);
  for (double& v : velocity) v = std::copysign(std::max(std::abs(v), 0.2), v);
  const std::map<std::string, Friction> joints{{"static", StribeckJoint()},
                                               {"static_rise", test::TwoLevelStribeckJoint()}};
  for (const auto& [rest, joint] : joints) {
    const Estimate estimate =
        AnswerTo(test::RecordFriction(joint, 0.1, velocity, 0.5, 7), {{"law", joint.law}});
    EXPECT_EQ(estimate.status, Status::not_identifiable);
    EXPECT_TRUE(estimate.parameters.empty());
    EXPECT_THAT(estimate.message, AllOf(HasSubstr(rest + " and stribeck_velocity"),
                                        HasSubstr("0.2 rad/s"), HasSubstr("down to about 0.02")));
  }
}

TEST(Stribeck, RefusesFrictionThatRisesFromRest) {
  Eigen::VectorXd velocity = test::SlowAndFast(4000, 9);
  // written out, as no friction file may say so
  Measurements m = test::Record(0.1, velocity, velocity);
  RandomStream random({9, 0}, Stream::torque_noise);
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    const double v = velocity[i];
    m.torque[i] =
        5 * v + Sign(v) * (20 - 5 * std::exp(-std::pow(v / 0.05, 2))) + 0.5 * random.Normal();
  }
  const Estimate estimate = AnswerTo(m);
  EXPECT_EQ(estimate.status, Status::inadequate_model);
  EXPECT_THAT(estimate.message, HasSubstr("friction rises from rest"));
  EXPECT_FALSE(estimate.friction);
}

class StribeckFitOf : public testing::TestWithParam<Friction> {};

TEST_P(StribeckFitOf, HasTheJacobianOfFiniteDifferences) {
  Friction warm = GetParam();
  warm.thermal = Thermal{-3, 60};
  const Measurements m = test::RecordFriction(warm, 0.1, test::SlowAndFast(500, 3), 0.3, 3);
  const Selection selection = SelectMoving(m);
  const FallingLaw& law = FindFallingLaw(warm.law);
  const StribeckProblem problem{m,  selection, FindIntervals(m.time), 2, FittedWarming::estimated,
                                10, law};
  const Eigen::Index levels = law.levels();
  StribeckPoint start;
  start.x.resize(levels + 3);
  const std::vector<double> values = LawValues(warm);
  start.x << Eigen::Map<const Eigen::VectorXd>(values.data(), levels), std::log(0.05), -3,
      std::log(60);
  const StribeckFit fit = RefineStribeck(problem, start);

  // the same forces by the model that predicts
  const auto force = [&](const Eigen::VectorXd& x) {
    Friction friction = warm;
    for (Eigen::Index i = 0; i < levels; ++i) {
      friction.parameters[std::string(law.law.parameters[static_cast<size_t>(i)].name)] = x[i];
    }
    friction.parameters["stribeck_velocity"] = std::exp(x[levels]);
    friction.thermal = Thermal{x[levels + 1], std::exp(x[levels + 2])};
    return PredictFriction(friction, m).force;
  };
  EXPECT_LT((force(fit.solution.x) - fit.fitted).cwiseAbs().maxCoeff(), 1e-10);
  for (Eigen::Index j = 0; j < levels + 3; ++j) {
    Eigen::VectorXd above = fit.solution.x, below = fit.solution.x;
    above[j] += 1e-5;
    below[j] -= 1e-5;
    const Eigen::VectorXd slope = (force(above) - force(below)) / 2e-5;
    // rounding 20 eps / 1e-5 and third derivatives of size 100 times 1e-10 / 6
    EXPECT_LT((slope - fit.jacobian.col(j)).cwiseAbs().maxCoeff(), 1e-7) << j;
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, StribeckFitOf,
                         testing::Values(StribeckJoint(), test::TwoLevelStribeckJoint()),
                         [](const auto& member) { return member.param.law; });

}  // namespace
}  // namespace warmjoint
