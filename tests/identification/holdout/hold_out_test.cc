#include "identification/holdout/hold_out.h"

#include <gtest/gtest.h>
#include <warmjoint/prepared_log.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "identification/fit/fit_parameters.h"
#include "identification/forward/log_trajectory.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/preparation/select.h"
#include "tests/support/judging.h"

namespace warmjoint {
namespace {

/// A fit by `identifier` with its default options on a recording that moves or rests.
struct Trial {
  Identifier identifier;
  Measurements measurements;
  Selection selection = SelectMoving(measurements);

  IdentifierInput input() const {
    return {Prepare(measurements, selection), identifier.options, {}};
  }
};

/// Says 5 v + 15 sign(v), warming as Table I, whatever it is shown; notes how much it was shown.
Eigen::Index shown = 0;
Fit KnowTableOne(const IdentifierInput& input) {
  shown = input.measurements.size();
  EXPECT_EQ(input.selection.keep.size(), shown);
  Fit fit;
  fit.model.friction = test::TableOne();
  fit.rows.errors.covariance = [] { return Uncertainty{}; };
  return fit;
}
const Identifier kKnowing{"knowing", "", {}, &KnowTableOne};

Fit KnowThatItStartedWarm(const IdentifierInput& input) {
  Fit fit = KnowTableOne(input);
  fit.start.energy = -6;
  return fit;
}

Fit KnowNothing(const IdentifierInput&) {
  return Refused("nothing", Status::not_identifiable, "nothing is known");
}

Measurements Recording(std::uint64_t seed, double noise) {
  return test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(1000, seed, 300), noise,
                              seed);
}

TEST(HoldOut, FitsOnTheFirstPartAndEvaluatesOnTheRest) {
  const Trial fit{kKnowing, Recording(1, 0)};
  const auto metrics = HoldOut(fit.identifier, fit.input(), 0.25).metrics;
  ASSERT_TRUE(metrics);
  // three quarters of the samples that move, whatever rests lie between
  const Eigen::Index kept = fit.selection.count(),
                     first = std::llround(0.75 * static_cast<double>(kept));
  EXPECT_EQ(fit.selection.keep.head(shown).count(), first);
  EXPECT_EQ(metrics->n, kept - first);
  EXPECT_EQ(metrics->parameters, 4);
}

TEST(HoldOut, StartsAsWarmAsTheFitSaysAndComesToTheTestPartWarm) {
  // exact friction leaves no residual only if E is carried through the training part
  Trial fit{{"started", "", {}, &KnowThatItStartedWarm}, Recording(2, 0)};
  fit.measurements.torque =
      PredictFriction(test::TableOne(), LogSamples(fit.measurements), {-6}).force;
  EXPECT_LT(HoldOut(fit.identifier, fit.input(), 0.25).metrics->rmse, 1e-12);
}

TEST(HoldOut, JumpsAtGapsAsTheFitSays) {
  const auto identify = [](const IdentifierInput& input) {
    Fit fit = KnowTableOne(input);
    fit.start.jump_samples = {100};
    fit.parameters = {WithValue(JumpUnknown(NameOf(Role::jump), UnitsOf(input.measurements)), -2)};
    fit.parameters[0].estimated = false;
    return fit;
  };
  Trial fit{{"jumps", "", {}, identify}, Recording(2, 0)};
  Measurements& m = fit.measurements;
  // ten minutes without samples while the joint moves
  m.time.tail(900).array() += 600;
  m.torque = PredictFriction(test::TableOne(), LogSamples(m), {0, 0, {{100, -2}}}).force;
  EXPECT_LT(HoldOut(fit.identifier, fit.input(), 0.25).metrics->rmse, 1e-12);
}

TEST(HoldOut, EvaluatesOnAnotherRecordingFromCold) {
  const Trial fit{kKnowing, Recording(3, 0.5)};
  const Measurements other = Recording(4, 0.5);
  const auto metrics =
      HoldOut(fit.identifier, fit.identifier.fit(fit.input()), Prepare(other, SelectMoving(other)))
          .metrics;
  ASSERT_TRUE(metrics);
  EXPECT_EQ(shown, 1000);
  // noise of 0.5 N.m over 700 samples: its standard deviation is known to 0.5 / sqrt(1400)
  EXPECT_NEAR(metrics->rmse, 0.5, 4 * 0.5 / std::sqrt(1400));
}

TEST(HoldOut, IsAbsentWhereThereIsNoFrictionToTest) {
  const Trial fit{{"nothing", "", {}, &KnowNothing}, Recording(5, 0)};
  EXPECT_FALSE(HoldOut(fit.identifier, fit.input(), 0.25).metrics);
}

TEST(HoldOut, TakesItsShareOfALogThatEndsWithARest) {
  Trial fit{kKnowing, Recording(6, 0)};
  fit.selection.keep.tail(400) = false;
  const auto metrics = HoldOut(fit.identifier, fit.input(), 0.25).metrics;
  ASSERT_TRUE(metrics);
  EXPECT_NEAR(metrics->n, 0.25 * static_cast<double>(fit.selection.count()), 1);
}

TEST(HoldOut, IsAbsentWhereNothingIsKept) {
  Trial fit{kKnowing, Recording(6, 0)};
  fit.selection.keep = false;
  EXPECT_FALSE(HoldOut(fit.identifier, fit.input(), 0.25).metrics);
}

/// Mean squared errors on six blocks of fits to the other five. [6]
std::optional<Eigen::VectorXd> ErrorsOfSixBlocks(const Identifier& identifier,
                                                 const Measurements& m) {
  const Trial fit{identifier, m};
  const std::vector<Eigen::Index> bounds = CutIntoBlocks(fit.selection, 6);
  const auto left = UnseenResiduals(fit.identifier, fit.input(), bounds);
  if (!left) return std::nullopt;
  Eigen::VectorXd errors(6);
  for (Eigen::Index b = 0; b < 6; ++b) {
    const auto first = bounds[static_cast<std::size_t>(b)];
    const Eigen::ArrayXd block =
        left->segment(first, bounds[static_cast<std::size_t>(b) + 1] - first);
    const auto finite = block.isFinite();
    errors[b] = finite.select(block.square(), 0).sum() / static_cast<double>(finite.count());
  }
  return errors;
}

TEST(BlockedHoldOut, HasTheErrorOfTheNoiseWhereTheModelIsRight) {
  const auto errors =
      ErrorsOfSixBlocks(FindIdentifier("energy-ml"), test::RecordHour(test::TableOne(), 4));
  ASSERT_TRUE(errors);
  // 0.25, known to sqrt(2 / 600) = 6 % on each block; five of these; a fit without the first ten
  // minutes hardly sees the time constant, so that its block is left out
  for (Eigen::Index b = 1; b < 6; ++b) EXPECT_NEAR((*errors)[b], 0.25, 0.25 * 0.3) << b;
}

TEST(BlockedHoldOut, SeesTheWarmingThatTheModelLacks) {
  const auto errors =
      ErrorsOfSixBlocks(FindIdentifier("nominal-ls"), test::RecordHour(test::TableOne(), 4));
  ASSERT_TRUE(errors);
  EXPECT_GT((*errors)[0], 10 * 0.25);  // the first ten minutes are the cold ones
}

TEST(BlockedHoldOut, StartsAsWarmAsTheFitSays) {
  Measurements m = test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(600, 4), 0, 4);
  m.torque = PredictFriction(test::TableOne(), LogSamples(m), {-6}).force;
  const auto errors = ErrorsOfSixBlocks({"knowing", "", {}, &KnowThatItStartedWarm}, m);
  ASSERT_TRUE(errors);
  EXPECT_EQ(errors->maxCoeff(), 0);
}

}  // namespace
}  // namespace warmjoint
