// What causes make of an answer, in whatever order, and values beyond their bounds.
#include "identification/inference/apply.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/prepared_log.h>

#include <algorithm>
#include <array>

#include "identification/fit/fit_data.h"
#include "identification/fit/fit_parameters.h"
#include "identification/inference/bounds.h"
#include "identification/preparation/select.h"
#include "tests/support/judging.h"

namespace warmjoint {
namespace {

/// viscous 5 +- 1 and coulomb 15 +- 2, as half widths.
Inference ByNoise() {
  Inference inference;
  inference.message = "fitted";
  inference.gives_friction = true;
  inference.parameters = {{5, 0.5, {{4, 6}}}, {15, 1, {{13, 17}}}};
  return inference;
}

Cause Moves(Source source, Action action, double viscous, double coulomb) {
  return {.source = source,
          .action = action,
          .rows = {0, 1},
          .bias = Eigen::Vector2d(viscous, coulomb)};
}

std::vector<Cause> Rows() {
  std::vector<Cause> rows{Moves(Source::rounding, Action::shift, 0.25, 0),
                          Moves(Source::gaps, Action::widen, -0.5, 1),
                          Moves(Source::findings, Action::widen, 0.5, -1),
                          Moves(Source::open_drift, Action::note, 100, 100)};
  rows[2].spread = Eigen::Vector2d(0, 1);
  rows[1].sentence = "gaps";
  rows[2].sentence = "findings";
  return rows;
}

TEST(Apply, AddsUpWhatRowsDo) {
  const Inference answer = Apply(ByNoise(), Rows());
  EXPECT_EQ(answer.status, Status::ok);
  EXPECT_DOUBLE_EQ(answer.parameters[0].value, 5.25);
  EXPECT_DOUBLE_EQ((*answer.parameters[0].interval95)[0], 4 + 0.25 - 1);
  EXPECT_DOUBLE_EQ((*answer.parameters[0].interval95)[1], 6 + 0.25 + 1);
  // 1 and 1, and 1.96 of what findings scatter
  EXPECT_DOUBLE_EQ((*answer.parameters[1].interval95)[0], 13 - 3.96);
  EXPECT_DOUBLE_EQ((*answer.parameters[1].interval95)[1], 17 + 3.96);
}

TEST(Apply, CountsTheWorstOfTheRowsOfOneSource) {
  const Inference answer = Apply(ByNoise(), {Moves(Source::open_drift, Action::widen, -3, 0),
                                             Moves(Source::open_drift, Action::widen, 1, 2),
                                             Moves(Source::gaps, Action::widen, 0.5, 0)});
  EXPECT_DOUBLE_EQ((*answer.parameters[0].interval95)[1], 6 + 3 + 0.5);
  EXPECT_DOUBLE_EQ((*answer.parameters[1].interval95)[1], 17 + 2);
}

TEST(Apply, MovesFrictionAtASpeedByWhatParametersDoTogether) {
  Inference inference = ByNoise();
  inference.at_speeds = {{{2, 25, 0.5, {24, 26}}, Eigen::Vector2d(2, 1)},
                         {{1, 20, 0.5, {19, 21}}, Eigen::Vector2d(1, 1)}};
  // a slope that goes with a level: 2 x 1 - 2; and its scatter the same way, 2 x 0.5 - 1
  Cause row = Moves(Source::findings, Action::widen, 1, -2);
  row.spread = Eigen::Vector2d(0.5, -1);
  const Inference answer = Apply(inference, {row, Moves(Source::rounding, Action::shift, 1, 0)});
  ASSERT_EQ(answer.at_speeds.size(), 2u);
  EXPECT_DOUBLE_EQ(answer.at_speeds[0].at.value, 27);
  EXPECT_DOUBLE_EQ(answer.at_speeds[0].at.interval95[0], 26);
  EXPECT_DOUBLE_EQ(answer.at_speeds[1].at.interval95[1], 22 + 1 + 1.96 * 0.5);

  // without a number that it depends on, or by name, there is none; nor of an answer that is refused
  EXPECT_TRUE(Apply(inference, {{.without_interval = {1}}}).at_speeds.empty());
  const Inference left = Apply(inference, {{.without_speed = {0}}});
  ASSERT_EQ(left.at_speeds.size(), 1u);
  EXPECT_EQ(left.at_speeds[0].at.speed, 1);
  EXPECT_TRUE(Apply(inference, {Invalidate(Status::bad_data, "faulty")}).at_speeds.empty());
}

TEST(Apply, TellsPartsThatAddUpToTheHalfWidth) {
  Inference inference = ByNoise();
  inference.parameters[0].parts = {{Source::noise, 1}};
  // what covers reaches to one side, and noise is then left on one side alone
  const Inference answer = Apply(inference, {Moves(Source::held_losses, Action::cover, 10, 0),
                                             Moves(Source::findings, Action::widen, 2, 0)});
  double sum = 0;
  for (const WidthPart& part : answer.parameters[0].parts) {
    EXPECT_GT(part.half_width, 0);
    sum += part.half_width;
  }
  EXPECT_NEAR(sum, answer.parameters[0].HalfWidth(), 1e-12);
}

TEST(Apply, CoversTheValueAndTheValueMoved) {
  const Inference far = Apply(ByNoise(), {Moves(Source::held_losses, Action::cover, 100, -100)});
  // of ends far apart each is left on one side alone: 1.645 of 1.96 half widths
  EXPECT_NEAR((*far.parameters[0].interval95)[0], 5 - 1.645 / 1.96, 1e-3);
  EXPECT_NEAR((*far.parameters[0].interval95)[1], 105 + 1.645 / 1.96, 1e-3);
  EXPECT_NEAR((*far.parameters[1].interval95)[0], -85 - 2 * 1.645 / 1.96, 1e-3);
  const Inference near = Apply(ByNoise(), {Moves(Source::held_losses, Action::cover, 1e-9, 0)});
  EXPECT_NEAR((*near.parameters[0].interval95)[1], 6, 1e-3);
}

TEST(Apply, TakesTheRefusalThatSaysMost) {
  std::vector<Cause> rows = Rows();
  rows.push_back({.source = Source::few_samples,
                  .action = Action::refuse,
                  .status = Status::not_identifiable,
                  .sentence = "few"});
  rows.push_back({.source = Source::faults,
                  .action = Action::refuse,
                  .status = Status::bad_data,
                  .sentence = "faulty"});
  rows.push_back({.source = Source::recording,
                  .sentence = "of the log",
                  .sentence_in = SentenceIn::any_answer});
  const Inference answer = Apply(ByNoise(), rows);
  EXPECT_EQ(answer.status, Status::bad_data);
  EXPECT_EQ(answer.message, "faulty");
  EXPECT_EQ(answer.warnings, std::vector<std::string>{"of the log"});
  EXPECT_FALSE(answer.gives_friction || answer.parameters[0].interval95 ||
               answer.parameters[1].std);
  EXPECT_DOUBLE_EQ(answer.parameters[0].value, 5.25);
}

TEST(Apply, HoldsValuesAndLeavesTheirIntervals) {
  std::vector<Cause> rows{Moves(Source::bound, Action::hold, -0.5, 0.25),
                          Moves(Source::gaps, Action::widen, 0.5, 0)};
  rows[0].sentence = "held";
  const Inference answer = Apply(ByNoise(), rows);
  EXPECT_EQ(answer.warnings, std::vector<std::string>{"held"});
  EXPECT_DOUBLE_EQ(answer.parameters[0].value, 4.5);
  EXPECT_DOUBLE_EQ((*answer.parameters[0].interval95)[0], 3.5);
  EXPECT_DOUBLE_EQ((*answer.parameters[0].interval95)[1], 6.5);
  EXPECT_DOUBLE_EQ(answer.parameters[1].value, 15.25);
  EXPECT_DOUBLE_EQ((*answer.parameters[1].interval95)[0], 13);
}

TEST(Apply, DoesNotDependOnTheOrderOfRows) {
  std::vector<Cause> rows = Rows();
  rows.push_back(Moves(Source::held_losses, Action::cover, 0.5, -0.25));
  rows.push_back({.source = Source::unadjusted_findings, .without_interval = {1}});
  const Inference first = Apply(ByNoise(), rows);
  EXPECT_FALSE(first.parameters[1].interval95);
  std::array<int, 6> order{0, 1, 2, 3, 4, 5};
  do {
    std::vector<Cause> turned;
    for (const int i : order) turned.push_back(rows[static_cast<std::size_t>(i)]);
    const Inference answer = Apply(ByNoise(), turned);
    ASSERT_EQ(answer.warnings, first.warnings);
    ASSERT_DOUBLE_EQ(answer.parameters[0].value, first.parameters[0].value);
    ASSERT_DOUBLE_EQ((*answer.parameters[0].interval95)[0], (*first.parameters[0].interval95)[0]);
    ASSERT_DOUBLE_EQ((*answer.parameters[0].interval95)[1], (*first.parameters[0].interval95)[1]);
  } while (std::ranges::next_permutation(order).found);
}

using ::testing::HasSubstr;

/// A fit of a law with these values, known to +- 0.1, before it is judged.
struct Judged {
  Fit fit;
  Inference inference;

  Judged(const char* law, const std::vector<double>& values) {
    const Eigen::Map<const Eigen::VectorXd> x(values.data(),
                                              static_cast<Eigen::Index>(values.size()));
    fit.model.friction = FrictionOf(*FindLaw(law), x, {});
    fit.parameters = WithValues(LawUnknowns(*FindLaw(law), x.size(), UnitsOf({})), x);
    inference.message = "fitted";
    for (const double value : values) {
      inference.parameters.push_back({value, 0.05, {{value - 0.1, value + 0.1}}});
    }
  }

  const Inference& Judge() {
    const auto cause = BeyondBounds(fit, inference);
    inference.gives_friction = true;
    if (cause) inference = Apply(inference, {*cause});
    return inference;
  }
};

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

TEST(WithinBounds, HoldsWhatNoisePutsOutside) {
  // without viscous friction half of the values fall below 0, and 2.5 % with their whole interval
  Friction friction{"viscous_coulomb", {{"viscous", 0}, {"coulomb", 15}}, {}, 0, 1};
  int held = 0, voided = 0, covered = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const Measurements m =
        test::RecordFriction(friction, 1, test::AlternatingSpeeds(400, seed), 0.5, seed);
    const PreparedLog log = Prepare(m, SelectMoving(m));
    const Estimate estimate = test::Fitted("nominal-ls", log);
    voided += estimate.status == Status::inadequate_model;
    if (estimate.status != Status::ok) continue;
    ASSERT_TRUE(estimate.friction);
    const EstimatedParameter &viscous = *estimate.Find("viscous"),
                             &coulomb = *estimate.Find("coulomb");
    EXPECT_GE((*viscous.interval95)[0], viscous.value > 0 ? -1 : 0);
    covered += test::Holds(estimate, "coulomb", 15);
    if (viscous.value > 0) continue;
    ++held;

    // the fit is that of the law without the parameter
    const Estimate other = test::Fitted("nominal-ls", log, {{"law", "coulomb"}});
    EXPECT_NEAR(coulomb.value, other.Find("coulomb")->value, 1e-9);
    EXPECT_NEAR(estimate.metrics->rmse, other.metrics->rmse, 1e-9);
  }
  // binomial: 190 +- 3 x 10, 10 + 3 x 3.1, and 95 % of 390 less 3 x 4.3
  EXPECT_NEAR(held, 190, 30);
  EXPECT_LE(voided, 20);
  EXPECT_GT(covered, 0.95 * (400 - voided) - 13);
}

TEST(WithinBounds, HoldsSeveralRowsAtOnce) {
  // levels of both directions that are 0, and a slope: the fit is that of the slope alone wherever both levels are held
  Friction friction{
      "asymmetric", {{"viscous", 4}, {"coulomb_positive", 0}, {"coulomb_negative", 0}}, {}, 0, 1};
  int both = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Measurements m =
        test::RecordFriction(friction, 1, test::AlternatingSpeeds(400, seed), 0.5, seed);
    const PreparedLog log = Prepare(m, SelectMoving(m));
    const Estimate estimate = test::Fitted("nominal-ls", log, {{"law", "asymmetric"}});
    if (estimate.status != Status::ok) continue;
    const double forwards = estimate.Find("coulomb_positive")->value;
    const double backwards = estimate.Find("coulomb_negative")->value;
    EXPECT_GE(forwards, 0);
    EXPECT_GE(backwards, 0);
    if (forwards > 0 || backwards > 0) continue;
    ++both;
    const LogSamples& seen = log.constant_speed().measurements;
    const Eigen::VectorXd v = Kept(seen.velocity, log.constant_speed().selection);
    const Eigen::VectorXd torque = Kept(seen.torque, log.constant_speed().selection);
    EXPECT_NEAR(estimate.Find("viscous")->value, v.dot(torque) / v.squaredNorm(), 1e-9);
  }
  EXPECT_GT(both, 3);
}

TEST(WithinBounds, HoldsALawBesideGravityOverPlaces) {
  Friction friction{"viscous_coulomb", {{"viscous", 0}, {"coulomb", 15}}, {}, 0, 1};
  int answered = 0, held = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Measurements m =
        test::RecordFriction(friction, 1, test::AlternatingSpeeds(2000, seed), 0.5, seed);
    m.torque.array() += 8 * m.position.array().sin();
    const PreparedLog log = Prepare(m, SelectMoving(m));
    const Estimate estimate = test::Fitted("nominal-ls", log, {{"gravity", "paired"}});
    if (estimate.status != Status::ok) continue;
    ++answered;
    if (estimate.Find("viscous")->value > 0) continue;
    ++held;
    // law and gravity are fitted anew with the bound
    const Estimate other =
        test::Fitted("nominal-ls", log, {{"law", "coulomb"}, {"gravity", "paired"}});
    EXPECT_NEAR(estimate.Find("coulomb")->value, other.Find("coulomb")->value, 1e-9);
    EXPECT_TRUE(estimate.gravity->values.isApprox(other.gravity->values, 1e-9));
  }
  // half are held, and 2.5 % outside with their whole interval: binomial, three deviations
  EXPECT_GE(answered, 17);
  EXPECT_NEAR(held, 10, 3 * 2.3);
}

TEST(WithinBounds, HoldsTheLawOfAJointThatWarms) {
  Friction friction{"viscous_coulomb", {{"viscous", 0}, {"coulomb", 15}}, {}, 0, 1};
  friction.thermal = Thermal{-1.5, 600};
  int held = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const Measurements m =
        test::RecordFriction(friction, 1, test::AlternatingSpeeds(3600, seed), 0.5, seed);
    const PreparedLog log = Prepare(m, SelectMoving(m));
    const Estimate estimate = test::Fitted("energy-ml", log);
    if (estimate.status != Status::ok || estimate.Find("viscous")->value > 0) continue;
    ++held;
    // the squares are quadratic within the noise: the other unknowns are those of the fit without the slope
    const Estimate other = test::Fitted("energy-ml", log, {{"law", "coulomb"}});
    for (const char* name : {"coulomb", "thermal_gain", "thermal_time_constant"}) {
      const EstimatedParameter& one = *estimate.Find(name);
      EXPECT_NEAR(one.value, other.Find(name)->value, 0.05 * *one.std) << name;
    }
  }
  EXPECT_GT(held, 0);
}

}  // namespace
}  // namespace warmjoint
