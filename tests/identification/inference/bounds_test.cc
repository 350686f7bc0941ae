#include "identification/inference/bounds.h"

#include <gmock/gmock.h>
#include <warmjoint/prepared_log.h>

#include "identification/answer/identify.h"
#include "identification/fit_parameters.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/inference/apply.h"
#include "identification/preparation/select.h"
#include "tests/support/warm_recording.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

/// A fit of a law with these values, known to +- 0.1, before it is judged.
struct Judged {
  Fit fit;
  Inference inference;

  Judged(const char* law, const std::vector<double>& values) {
    const Eigen::Map<const Eigen::VectorXd> x(values.data(),
                                              static_cast<Eigen::Index>(values.size()));
    fit.friction = FrictionOf(*FindLaw(law), x, {});
    fit.parameters = LawParameters(*FindLaw(law), x, {});
    inference.message = "fitted";
    for (const double value : values) {
      inference.parameters.push_back({value, 0.05, {{value - 0.1, value + 0.1}}, 0});
    }
  }

  const Inference& Judge() {
    const auto cause = BeyondBounds(fit, inference);
    inference.gives_friction = true;
    if (cause) inference = Apply(inference, {*cause});
    return inference;
  }
};

TEST(BeyondBounds, GivesTheFrictionOfValuesWithinTheirBounds) {
  Judged judged("viscous_coulomb", {0, 2});
  EXPECT_TRUE(judged.Judge().gives_friction);
  EXPECT_EQ(judged.inference.message, "fitted");
  EXPECT_TRUE(judged.inference.warnings.empty());
}

TEST(BeyondBounds, VoidsWhatWasNotHeldAtItsBound) {
  // with a part of the interval within, and without an interval
  Judged judged("viscous_coulomb", {-0.05, 2});
  EXPECT_EQ(judged.Judge().status, Status::inadequate_model);
  EXPECT_THAT(judged.inference.message, HasSubstr("viscous is -0.05 N.m.s/rad, below its bound 0"));
  Judged unknown("viscous_coulomb", {-3, -2});
  for (ParameterInterval& one : unknown.inference.parameters) one.interval95.reset();
  EXPECT_EQ(unknown.Judge().status, Status::inadequate_model);
  EXPECT_FALSE(unknown.inference.gives_friction);
}

TEST(BeyondBounds, VoidsTheFitWhoseIntervalIsWhollyOutside) {
  Judged judged("viscous_coulomb", {0.5, -2});
  EXPECT_EQ(judged.Judge().status, Status::inadequate_model);
  EXPECT_FALSE(judged.inference.parameters[1].interval95);
  EXPECT_THAT(judged.inference.message, HasSubstr("coulomb is -2 N.m, below its bound 0"));
  EXPECT_TRUE(judged.inference.warnings.empty());
  EXPECT_FALSE(judged.inference.gives_friction);
}

TEST(BeyondBounds, DoesNotLetFrictionRiseFromRestInBothDirections) {
  // viscous, forwards, backwards, static_rise, stribeck_velocity, exponent; beyond doubt or by chance
  for (const double rise : {-1.0, -0.05}) {
    Judged judged("asymmetric_stribeck", {1, 2, 3, rise, 0.1, 2});
    EXPECT_EQ(judged.Judge().status, Status::inadequate_model);
    EXPECT_THAT(judged.inference.message, HasSubstr("static_rise is below 0: friction rises"));
    EXPECT_THAT(judged.inference.message,
                HasSubstr("try --identifier nominal-ls --set law=asymmetric"));
  }
  Judged judged("asymmetric_stribeck", {1, 2, 3, 0, 0.1, 2});
  EXPECT_EQ(judged.Judge().status, Status::ok);
}

TEST(AtBounds, HoldsWhatNoisePutsBeyond) {
  // without viscous friction half of the values fall below 0, and 2.5 % with their whole interval
  Friction friction{"viscous_coulomb", {{"viscous", 0}, {"coulomb", 15}}, {}, 0, 1};
  const Identifier& identifier = FindIdentifier("nominal-ls");
  int held = 0, voided = 0, covered = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const Measurements m =
        test::RecordFriction(friction, 1, test::AlternatingSpeeds(400, seed), 0.5, seed);
    const Selection selection = SelectMoving(m);
    const PreparedLog log = Prepare(m, selection);
    const Estimate estimate = IdentifyUnchecked(identifier, {log, identifier.options, {}});
    voided += estimate.status == Status::inadequate_model;
    if (estimate.status != Status::ok) continue;
    ASSERT_TRUE(estimate.friction);
    const EstimatedParameter &viscous = *estimate.Find("viscous"),
                             &coulomb = *estimate.Find("coulomb");
    EXPECT_GE((*viscous.interval95)[0], viscous.value > 0 ? -1 : 0);
    covered += (*coulomb.interval95)[0] <= 15 && 15 <= (*coulomb.interval95)[1];
    if (viscous.value > 0) continue;
    ++held;

    // the other is that of the law without the parameter, but for what colour and unevenness of the noise seem to tell;
    // the fitted torque, too
    const Estimate other =
        IdentifyUnchecked(identifier, {log, identifier.options.Read({{"law", "coulomb"}}), {}});
    EXPECT_NEAR(coulomb.value, other.Find("coulomb")->value, 0.2 * *coulomb.std);
    EXPECT_NEAR(estimate.metrics->rmse, other.metrics->rmse, 1e-4 * other.metrics->rmse);
  }
  // binomial: 190 +- 3 x 10, 10 + 3 x 3.1, and 95 % of 390 less 3 x 4.3
  EXPECT_NEAR(held, 190, 30);
  EXPECT_LE(voided, 20);
  EXPECT_GT(covered, 0.95 * (400 - voided) - 13);
}

}  // namespace
}  // namespace warmjoint
