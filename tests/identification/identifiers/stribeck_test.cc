#include <gmock/gmock.h>

#include <cmath>

#include "identification/forward/log_trajectory.h"
#include "identification/nonlinear/stribeck_fit.h"
#include "identification/preparation/select.h"
#include "tests/support/judging.h"

namespace warmjoint {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

Estimate AnswerTo(const Measurements& m, const std::map<std::string, std::string>& given = {}) {
  return test::Fitted("stribeck", m, given);
}

using test::StribeckJoint;

Friction Warm(Friction joint) {
  joint.thermal = Thermal{-3, 60};
  return joint;
}

/// The answer that fits the joint's own law to its log. n: samples at 0.1 s; noise: N.m.
Estimate AnswerOf(const Friction& joint, Eigen::Index n, double noise, std::uint64_t seed) {
  return AnswerTo(test::RecordFriction(joint, 0.1, test::SlowAndFast(n, seed), noise, seed),
                  {{"law", joint.law}, {"warming", joint.thermal ? "estimated" : "none"}});
}

TEST(Stribeck, HoldsTheTruthInItsIntervals) {
  for (const Friction& joint :
       {StribeckJoint(), test::TwoLevelStribeckJoint(), Warm(test::TwoLevelStribeckJoint())}) {
    SCOPED_TRACE(joint.law);
    // 38 of 40 expected, binomial deviation 1.4; four of them
    test::ExpectHeld(40, 32, test::TruthOf(joint),
                     [&](std::uint64_t seed) { return AnswerOf(joint, 4000, 0.5, seed); });
  }
}

TEST(Stribeck, HoldsTheTruthBesideGravity) {
  for (const Friction& joint : {StribeckJoint(), Warm(test::TwoLevelStribeckJoint())}) {
    SCOPED_TRACE(joint.law);
    std::map<std::string, double> truth = test::TruthOf(joint);
    truth.insert({{"gravity_sine", 8}, {"gravity_cosine", -3}});
    const auto answer = [&](std::uint64_t seed) {
      Measurements m = test::RecordFriction(joint, 0.1, test::SlowAndFast(4000, seed), 0.5, seed);
      m.torque.array() += 8 * m.position.array().sin() - 3 * m.position.array().cos();
      return AnswerTo(m, {{"law", joint.law},
                          {"gravity", "sincos"},
                          {"warming", joint.thermal ? "estimated" : "none"}});
    };
    // 38 of 40 expected, binomial deviation 1.4; four of them
    test::ExpectHeld(40, 32, truth, answer);
  }
}

TEST(Stribeck, HoldsTheTruthInMotionOfAnyKind) {
  Friction joint = StribeckJoint();
  joint.parameters["stribeck_velocity"] = 0.3;
  std::map<std::string, double> truth = test::TruthOf(joint);
  truth.insert({{"gravity_sine", test::kSine}, {"inertia", test::kInertia}});
  test::ExpectHeld(40, 32, truth, [&](std::uint64_t seed) {
    return AnswerTo(test::Excited(joint, 6000, seed), {{"gravity", "sincos"}});
  });
}

TEST(Stribeck, AutoTakesItBesideGravity) {
  Measurements m = test::RecordFriction(StribeckJoint(), 0.1, test::SlowAndFast(6000, 5), 0.3, 5);
  m.torque.array() += 8 * m.position.array().sin() - 3 * m.position.array().cos();
  const Estimate estimate = test::Answer("auto", m, {{"gravity", "sincos"}});
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  EXPECT_EQ(estimate.friction->law, "stribeck") << estimate.message;
  EXPECT_TRUE(estimate.gravity);
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

TEST(Stribeck, TakesEachOfSeveralRecordingsFromCold) {
  // the same warm-up twice tells what it tells once, a root of two more surely
  const Measurements once =
      test::RecordFriction(Warm(StribeckJoint()), 0.1, test::SlowAndFast(4000, 3), 0.3, 3);
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
  const Friction warm = Warm(GetParam());
  const LogSamples m(test::RecordFriction(warm, 0.1, test::SlowAndFast(500, 3), 0.3, 3));
  const Selection selection = SelectMoving(m);
  const FallingLaw& law = FindFallingLaw(warm.law);
  const StribeckProblem problem{m, selection, 2, PartFit::estimated, law};
  const Eigen::Index levels = law.levels();
  const FallingPlaces at = problem.places();
  FitPoint start{Eigen::VectorXd(at.size())};
  const std::vector<double> values = LawValues(warm);
  at.law().In(start.x) = Eigen::Map<const Eigen::VectorXd>(values.data(), levels);
  start.x[at.log_vs()] = std::log(0.05);
  start.x[at.gain()] = -3;
  start.x[at.log_time_constant()] = std::log(60);
  const StribeckFit fit = RefineStribeck(problem, start);

  // the same forces by the model that predicts
  const auto force = [&](const Eigen::VectorXd& x) {
    Friction friction = warm;
    for (Eigen::Index i = 0; i < levels; ++i) {
      friction.parameters[std::string(law.law.parameters[static_cast<size_t>(i)].name)] =
          at.law().Of(x)[i];
    }
    friction.parameters["stribeck_velocity"] = std::exp(x[at.log_vs()]);
    friction.thermal = at.ThermalAt(x);
    return PredictFriction(friction, m).force;
  };
  EXPECT_LT((force(fit.solution.x) - fit.fitted).cwiseAbs().maxCoeff(), 1e-10);
  const Eigen::MatrixXd jacobian = ModelAt(*fit.model, fit.solution.x).All().derivatives;
  for (Eigen::Index j = 0; j < at.size(); ++j) {
    Eigen::VectorXd above = fit.solution.x, below = fit.solution.x;
    above[j] += 1e-5;
    below[j] -= 1e-5;
    const Eigen::VectorXd slope = (force(above) - force(below)) / 2e-5;
    // rounding 20 eps / 1e-5 and third derivatives of size 100 times 1e-10 / 6
    EXPECT_LT((slope - jacobian.col(j)).cwiseAbs().maxCoeff(), 1e-7) << j;
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, StribeckFitOf,
                         testing::Values(StribeckJoint(), test::TwoLevelStribeckJoint()),
                         [](const auto& member) { return member.param.law; });

}  // namespace
}  // namespace warmjoint
