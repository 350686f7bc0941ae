#include "tools/shown/run/run_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/tools/scratch_directory.h"
#include "tools/board/board_tables.h"
#include "tools/board/format_board.h"

namespace warmjoint::shown {
namespace {

using ::testing::HasSubstr;

constexpr const char* kSuite =
    "name: little\nquestion: How much is drawn?\nseed: 7\nrealizations: 5\nidentifiers: "
    "[{name: nominal-ls}, {name: external, label: mine, options: {command: python3 mine.py}}]\n"
    "scenario: {friction: {law: viscous_coulomb, parameters: {viscous: 5, coulomb: 15}},"
    " motion: {speeds: [1], hold: 2}, sampling: {rate: 10}, duration: 20}\n";

/// Realization i of both identifiers, whose NPE is i.
Realization Numbered(int i) {
  std::vector<Result> results;
  for (int identifier = 0; identifier < 2; ++identifier) {
    Result result;
    result.realization = i;
    result.identifier = identifier;
    result.status = "ok";
    const ParameterScore one{"coulomb", 15, 15.0 + i, true, i % 2 == 0, 0.5};
    result.metrics = Metrics{100, 1, 1, 0.5, 0.4, 95, 0.25};
    result.score = Score{{one}, {one}, static_cast<double>(i), static_cast<double>(i), 0.05, 0.05};
    results.push_back(result);
  }
  return {{0, i}, 0.1, results};
}

class LittleRun : public testing::Test {
 protected:
  RunStore Store(std::initializer_list<int> realizations) {
    RunStore store =
        RunStore::CreateOrResume(scratch_.path() / "run", {kSuite, {{"warmjoint", "0.1.0"}}});
    std::vector<Realization> all;
    for (const int i : realizations) all.push_back(Numbered(i));
    store.Write(all);
    return store;
  }

 private:
  ScratchDirectory scratch_;
};

TEST_F(LittleRun, HasABestAMedianAndAWorstRealizationEachOnce) {
  const auto extremes = ExtremesOf(Store({3, 1, 4, 0}), 0);
  ASSERT_EQ(extremes.size(), 3u);
  EXPECT_EQ(extremes[0].unit.realization, 0);
  EXPECT_EQ(extremes[1].unit.realization, 1) << "of an even number the lower";
  EXPECT_EQ(extremes[2].unit.realization, 4);
  EXPECT_EQ(extremes[2].npe, 4);
}

TEST_F(LittleRun, OfOneRealizationHasOneExtreme) {
  EXPECT_EQ(ExtremesOf(Store({2}), 1).size(), 1u);
}

TEST_F(LittleRun, TellsOnItsPageWhatWasSimulatedAndTheNumbersOfCompare) {
  const RunStore store = Store({0, 1, 2});
  ShownData data;
  std::string told;
  const Tree facts = RunPageFacts(store, data, [&](const std::string& words) { told += words; });
  const Leaderboard board = ReadBoard(store);
  EXPECT_EQ(facts["board"], Tree::parse(BoardToJson(board)));
  EXPECT_EQ(facts["verdict"], Verdict(board));
  EXPECT_EQ(facts["boards"][0]["rows"], Tree(RankingTable(board).rows));
  EXPECT_THAT(std::string(facts["simulated"][1]), HasSubstr("viscous_coulomb"));
  EXPECT_EQ(facts["entries"][1][1], "a command from outside: python3 mine.py");
  EXPECT_EQ(facts["replay"][0], "warmjoint simulate --from RUN --realization 0 -o replay");
  EXPECT_EQ(facts["extremes"].size(), 3u) << told;
  EXPECT_EQ(facts["parameters"]["coulomb"], (Tree{"kc", "N.m"}));
}

}  // namespace
}  // namespace warmjoint::shown
