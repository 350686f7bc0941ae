#include "identification/holdout/blocked_hold_out.h"

#include "identification/identifiers/energy_ml.h"
#include "identification/identifiers/nominal_ls.h"
#include "identification/preparation/prepare.h"
#include "identification/preparation/select.h"
#include "identification/read_options.h"
#include "tests/support/warm_recording.h"

namespace warmjoint {
namespace {

TEST(BlockedHoldOut, HasTheErrorOfTheNoiseWhereTheModelIsRight) {
  const Measurements m =
      test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(3600, 4), 0.5, 4);
  const Selection selection = SelectMoving(m);
  const Identifier warm = EnergyMl();
  const Options options = ReadOptions(warm.options, {}, {});
  const auto errors =
      BlockedErrors(warm, {Prepare(m, selection), options, {}}, CutIntoBlocks(selection, 6));
  ASSERT_TRUE(errors);
  // 0.25, known to sqrt(2 / 600) = 6 % on each block; five of these; a fit without the first ten
  // minutes hardly sees the time constant, so that its block is left out
  for (Eigen::Index b = 1; b < 6; ++b) EXPECT_NEAR((*errors)[b], 0.25, 0.25 * 0.3) << b;
}

TEST(BlockedHoldOut, SeesTheWarmingThatTheModelLacks) {
  const Measurements m =
      test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(3600, 4), 0.5, 4);
  const Selection selection = SelectMoving(m);
  const Identifier cold = NominalLs();
  const Options options = ReadOptions(cold.options, {}, {});
  const auto errors =
      BlockedErrors(cold, {Prepare(m, selection), options, {}}, CutIntoBlocks(selection, 6));
  ASSERT_TRUE(errors);
  EXPECT_GT((*errors)[0], 10 * 0.25);  // the first ten minutes are the cold ones
}

TEST(BlockedHoldOut, StartsAsWarmAsTheFitSays) {
  const Identifier knowing{"knowing", "", {}, [](const IdentifierInput&) {
                             Fit fit;
                             fit.friction = test::TableOne();
                             fit.initial_energy = -6;
                             fit.errors.known = Uncertainty{};
                             return fit;
                           }};
  Measurements m = test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(600, 4), 0, 4);
  m.torque = PredictFriction(test::TableOne(), m, {-6}).force;
  const Selection selection = SelectMoving(m);
  const Options options = ReadOptions(knowing.options, {}, {});
  const auto errors =
      BlockedErrors(knowing, {Prepare(m, selection), options, {}}, CutIntoBlocks(selection, 6));
  ASSERT_TRUE(errors);
  EXPECT_EQ(errors->maxCoeff(), 0);
}

}  // namespace
}  // namespace warmjoint
