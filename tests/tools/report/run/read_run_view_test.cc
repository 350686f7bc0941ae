#include <gtest/gtest.h>

#include "tests/tools/scratch_directory.h"
#include "tools/report/run/run_view.h"

namespace warmjoint::report {
namespace {

constexpr int kRealizations = 50;

/// Realization i, whose NPE is i; every second interval holds the truth, every tenth answer fails.
Realization Numbered(int i) {
  Result result;
  result.realization = i;
  result.status = i % 10 == 9 ? "not_converged" : "ok";
  const ParameterScore one{"coulomb", 15, 15.0 + i, true, i % 2 == 0, 0.5};
  result.metrics = Metrics{100, 1, 1, 0.5, 0.4, 95, 0.25};
  const auto npe = static_cast<double>(i);
  result.score = Score{{one}, {one}, npe, npe, 0.05, 0.05};
  return {{0, i}, 0.1, {result}};
}

RunView ReadNumbered(std::int64_t most_drawn) {
  const ScratchDirectory scratch;
  const RunDescription description{
      "name: little\nquestion: How much is drawn?\nseed: 7\nrealizations: 50\nidentifiers: "
      "[{name: nominal-ls}]\n"
      "scenario: {friction: {law: viscous_coulomb, parameters: {viscous: 5, coulomb: 15}},"
      " motion: {speeds: [1], hold: 2}, sampling: {rate: 10}, duration: 20}\n",
      {{"warmjoint", "0.1.0"}}};
  RunStore store = RunStore::CreateOrResume(scratch.path() / "run", description);
  std::vector<Realization> all;
  for (int i = 0; i < kRealizations; ++i) all.push_back(Numbered(i));
  store.Write(all);
  return ReadRunView(store, most_drawn);
}

TEST(ReadRunView, DrawsAllOfAShortRun) {
  const RunView view = ReadNumbered(kMostDrawn);
  EXPECT_EQ(view.drawn_every, 1);
  EXPECT_EQ(view.rows.at(0).npe, Eigen::VectorXd::LinSpaced(kRealizations, 0, kRealizations - 1));
}

TEST(ReadRunView, DrawsOneInSeveralOfALongOneAndCountsAll) {
  const RunView view = ReadNumbered(10);
  EXPECT_EQ(view.drawn_every, 5);
  EXPECT_EQ(view.realizations, kRealizations);
  const RunRow& row = view.rows.at(0);
  EXPECT_EQ(row.npe, Eigen::VectorXd::LinSpaced(10, 0, 45));
  EXPECT_EQ(row.parameters.at(0).estimate, (Eigen::VectorXd::LinSpaced(10, 15, 60)));
  EXPECT_EQ(row.runs, kRealizations);
  EXPECT_EQ(row.failures.at("not_converged"), 5);
  EXPECT_EQ(row.parameters[0].intervals, kRealizations);
  EXPECT_EQ(row.parameters[0].covered, kRealizations / 2);
}

}  // namespace
}  // namespace warmjoint::report
