// Identifiers, shards, keys and traces of a suite.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "models/foundation/bad_input.h"
#include "models/friction/thermal.h"
#include "tools/suite/engine.h"
#include "tools/suite/prepare_identifiers.h"
#include "tools/suite/run_realization.h"
#include "tools/terminal/shell_words.h"

namespace warmjoint {
namespace {

using ::testing::ElementsAre;

/// A suite of three: one identifier by two sets of options, and another.
const std::vector<SuiteIdentifier>& OfSuite() {
  static const std::vector<SuiteIdentifier> all{{"energy-als", "short", {{"iterations", "5"}}, {}},
                                                {"energy-als", "long", {{"iterations", "9"}}, {}},
                                                {"nominal-ls", "nominal-ls", {}, {}}};
  return all;
}

std::vector<std::string> Labels(const std::vector<std::string>& names,
                                const std::vector<SuiteIdentifier>& suite = OfSuite()) {
  std::vector<std::string> labels;
  for (const SuiteIdentifier& one : ChooseIdentifiers(suite, names)) labels.push_back(one.label);
  return labels;
}

TEST(ChooseIdentifiers, TakesAllOfASuiteUnlessSomeAreNamed) {
  EXPECT_THAT(Labels({}), ElementsAre("short", "long", "nominal-ls"));
  EXPECT_THAT(Labels({"nominal-ls", "long"}), ElementsAre("nominal-ls", "long"));
  EXPECT_THAT(Labels({"energy-als"}), ElementsAre("short", "long"));
  EXPECT_THAT(Labels({"long", "energy-als"}), ElementsAre("long", "short")) << "each once";

  // a + adds to them
  EXPECT_THAT(Labels({"+energy-ml"}), ElementsAre("short", "long", "nominal-ls", "energy-ml"));
  EXPECT_THAT(Labels({"+energy-ml", "long"}), ElementsAre("energy-ml", "long"));
}

TEST(ChooseIdentifiers, KnowsAnEarlierNameOnEitherSide) {
  EXPECT_THAT(Labels({"energy-em"}), ElementsAre("short", "long"));
  EXPECT_THAT(Labels({"energy-als"}, {{"energy-em", "old", {}, {}}}), ElementsAre("old"));

  // one that the suite lacks is that of the list, by its name of now
  const auto chosen = ChooseIdentifiers({}, {"energy-em"});
  ASSERT_EQ(chosen.size(), 1u);
  EXPECT_EQ(chosen[0].name, "energy-als");
  EXPECT_EQ(chosen[0].label, "energy-em") << "as it was asked for";
}

TEST(ChooseIdentifiers, RefusesWhatNobodyIsCalledAndALabelTwice) {
  EXPECT_THROW(Labels({"nominal-sl"}), BadInput);
  EXPECT_THROW(Labels({"mine=cat {recording}", "mine=cat {recording}"}), BadInput);
}

TEST(Shard, BlocksFollowOneAnotherWithoutGapsAndAreAlike) {
  for (const int realizations : {20, 2, 2'000'000'000}) {
    for (const int count : {1, 3, 7}) {
      int end = 0, least = realizations, most = 0;
      for (int index = 1; index <= count; ++index) {
        const Shard shard{index, count};
        EXPECT_EQ(shard.First(realizations), end);
        end = shard.End(realizations);
        least = std::min(least, end - shard.First(realizations));
        most = std::max(most, end - shard.First(realizations));
      }
      EXPECT_EQ(end, realizations);
      EXPECT_LE(most - least, 1);
    }
  }
  EXPECT_TRUE(Shard().IsWhole());
  EXPECT_EQ(ReadShard("2/3").index, 2);
}

TEST(Shard, RefusesWhatIsNoPart) {
  for (const char* text : {"", "1", "0/3", "4/3", "1/0", "a/b", "1/3/5", "-1/3", "2:3"}) {
    EXPECT_THROW(ReadShard(text), BadInput) << text;
  }
}

TEST(StartKeyOf, IsTheDigestOfSeedAndRealization) {
  // sha256sum of "warmjoint identifier start 7 2", its first 16 digits
  EXPECT_EQ(StartKeyOf(7, 2).digest[0], 0x81ec39becd243c62ull);
  EXPECT_NE(StartKeyOf(7, 2), StartKeyOf(7, 3));
  EXPECT_NE(StartKeyOf(7, 2), StartKeyOf(8, 2));
  // 1 and 23 are not 12 and 3
  EXPECT_NE(StartKeyOf(1, 23), StartKeyOf(12, 3));
}

constexpr double kStep = 1;  // s

/// The truth of k = -3 N.m/W, tau = 600 s at a step of 1 s.
Score TruthOfTable1() {
  const DiscreteThermal discrete = Discretise({-3, 600}, kStep);
  Score score;
  score.continuous = {{"thermal_gain", -3, 0, false, {}, 0},
                      {"thermal_time_constant", 600, 0, false, {}, 0}};
  score.discrete = {{"thermal_gain_discrete", discrete.gain, 0, false, {}, 0},
                    {"thermal_pole", discrete.pole, 0, false, {}, 0}};
  return score;
}

TEST(TraceTable, FollowsTheErrorOfBothPairs) {
  const std::vector<TraceEntry> trace{
      {0, {{"thermal_gain", -6}, {"thermal_time_constant", 600}}, 2.5},
      {7, {{"thermal_gain", -3}, {"thermal_time_constant", 600}}, 0.5},
  };
  const TraceTable table = MakeTraceTable(trace, TruthOfTable1(), kStep);
  EXPECT_THAT(table.columns, ElementsAre("iteration", "rmse", "npe_continuous", "npe_discrete",
                                         "thermal_gain", "thermal_time_constant"));
  EXPECT_THAT(table.values, ElementsAre(0, 2.5f, 1, 1, -6, 600, 7, 0.5f, 0, 0, -3, 600));
}

TEST(TraceTable, FindsTheContinuousPairOfADiscreteOne) {
  const DiscreteThermal discrete = Discretise({-3, 300}, kStep);
  const TraceTable table = MakeTraceTable(
      {{1, {{"thermal_gain_discrete", discrete.gain}, {"thermal_pole", discrete.pole}}, 1}},
      TruthOfTable1(), kStep);
  EXPECT_FLOAT_EQ(table.values[2], 0.5f) << "tau is half of its truth, k is right";
}

TEST(ShellWords, IsSplitAtBlanksOutsideQuotes) {
  EXPECT_THAT(SplitCommand("  python3 me.py\t--x=1 ", {}),
              ElementsAre("python3", "me.py", "--x=1"));
  EXPECT_THAT(SplitCommand("a 'b  c' \"d 'e\" f\\ g ''", {}),
              ElementsAre("a", "b  c", "d 'e", "f g", ""));
  EXPECT_THAT(SplitCommand("a $(b) `c` ; d | e > f", {}),
              ElementsAre("a", "$(b)", "`c`", ";", "d", "|", "e", ">", "f"))
      << "nothing is expanded";
  EXPECT_THROW(SplitCommand("a 'b", {}), BadInput);
}

TEST(ShellWords, JoinsToWhatSplitsToTheSame) {
  const std::vector<std::string> words{"a b",         "it's", "",     "$(x)",
                                       "{recording}", "a\"b", "c\\d", "e\nf"};
  EXPECT_EQ(SplitCommand(JoinCommand(words), {}), words);
  EXPECT_EQ(JoinCommand({"./run.py", "{recording}", "--n=3,4"}), "./run.py {recording} --n=3,4");
  EXPECT_EQ(JoinCommand({"/tmp/{a,b}/run", "{1..3}"}), "'/tmp/{a,b}/run' '{1..3}'");
}

}  // namespace
}  // namespace warmjoint
