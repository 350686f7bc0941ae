// The pages of a run and of a log.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "scenarios/suite.h"
#include "tests/tools/figures/look.h"
#include "tests/tools/figures/run/run_example.h"
#include "tests/tools/figures/warm_recording.h"
#include "tools/board/board_tables.h"
#include "tools/board/format_board.h"
#include "tools/figures/log_page.h"
#include "tools/figures/run/run_figures.h"
#include "tools/figures/run/run_page.h"

namespace warmjoint::figures {
namespace {

using ::testing::HasSubstr;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

constexpr const char* kSuite = R"(name: table1
question: Which?
realizations: 40
scenario:
  friction: {law: viscous_coulomb, parameters: {viscous: 5, coulomb: 15}}
  motion: {speeds: [1], hold: 2}
  duration: 60
identifiers: [{name: energy-ml}, {name: external, label: mine, options: {command: "python3 <mine>.py {recording} {estimate}"}}]
)";

Leaderboard ExampleBoard() {
  Leaderboard board;
  board.suite = "table1 <script>";
  board.question = "Which one is right & why?";
  board.realizations = board.finished = 40;
  board.bound_npe_continuous = 0.012;
  LeaderboardRow row;
  row.identifier = "energy-ml";
  row.runs = 40;
  row.failures = {{"not_converged", 2}};
  row.failure_example = "it <b>moved</b>";
  row.npe_continuous = {{0.011, 0.009, 0.013}, 0.0121};
  row.npe_discrete = row.npe_continuous;
  row.rmse = {{0.5, 0.49, 0.51}, 0.5};
  board.rows = {row};
  return board;
}

Tree ExampleData() {
  RunPage example;
  example.view = ExampleRun();
  example.view.board = ExampleBoard();
  example.view.listing.answers = {{{0, 3}, 0, "ok", 0.011, 0.5, 93},
                                  {{0, 4}, 1, "crashed", kUnknown, kUnknown, kUnknown}};
  example.suite = ParseSuite(kSuite, "suite.yaml");
  example.without_extremes = "Nothing could be simulated.";
  example.description.suite_yaml = "name: table1\n";
  example.description.versions = {{"warmjoint", "0.1.0"}};
  example.figures = {*NpeBoxes(ExampleRun())};
  return RunPageData(example);
}

TEST(RunPageData, HoldsQuestionVerdictNotesAndTheNumbersOfCompare) {
  const Tree data = ExampleData();
  EXPECT_EQ(data["question"], "Which one is right & why?");
  EXPECT_EQ(data["verdict"], Verdict(ExampleBoard()));
  EXPECT_THAT(data["notes"].dump(), HasSubstr("it <b>moved</b>"));
  EXPECT_EQ(data["boards"][0]["rows"], Tree(RankingTable(ExampleBoard()).rows));
  EXPECT_EQ(data["board"], Tree::parse(BoardToJson(ExampleBoard())));
  EXPECT_EQ(data["realizations"]["rows"].size(), 2u);
  EXPECT_EQ(data["realizations"]["rows"][1][3], "-") << "no number";
  EXPECT_EQ(data["figures"][0]["name"], "npe_boxes");
  EXPECT_EQ(data["versions"].size(), 1u);
}

TEST(AgreementTable, GivesEachVariantARowOfItsOwn) {
  Leaderboard board = ExampleBoard();
  EXPECT_EQ(AgreementTable(board).rows.size(), 1u);
  board.groups = {{ExampleBoard(), "quiet", {}}, {ExampleBoard(), "noisy", {}}};
  board.groups[1].rows[0].rmse.median = 5;
  const warmjoint::Table table = AgreementTable(board);
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_THAT(table.rows[1], testing::Contains("noisy"));
  EXPECT_THAT(table.rows[1], testing::Contains("5"));
}

TEST(Base64, EncodesTheVectorsOfRfc4648) {
  EXPECT_EQ(Picture::Base64(""), "");
  EXPECT_EQ(Picture::Base64("f"), "Zg==");
  EXPECT_EQ(Picture::Base64("fo"), "Zm8=");
  EXPECT_EQ(Picture::Base64("foo"), "Zm9v");
  EXPECT_EQ(Picture::Base64("foobar"), "Zm9vYmFy");
}

Tree DataOf(const WarmRecording& warm) {
  return LogPageData(
      {warm.View(), CheckRecording(warm.measurements), {"warmjoint identify warm.csv"}});
}

TEST(LogPageData, SaysWhyALogWasRefusedAndWhatToRecord) {
  WarmRecording warm;
  warm.estimate.status = Status::inadequate_model;
  warm.estimate.message = "the residual depends on direction <3 N.m>";
  Diagnostic direction;
  direction.test = "direction";
  direction.made = direction.rejected = true;
  direction.effect = 3;
  direction.effect_unit = "N.m";
  warm.estimate.diagnostics = {direction};
  const Tree data = DataOf(warm);
  EXPECT_FALSE(data["passed"]);
  EXPECT_FALSE(data["attachable"]);
  EXPECT_THAT(std::string(data["verdict"]),
              HasSubstr("the model does not describe these data: do not use the numbers"));
  EXPECT_THAT(data["remarks"].dump(), HasSubstr("The residual depends on direction <3 N.m>."));
  EXPECT_EQ(data["tests"]["rows"][0][1], "yes");
  EXPECT_THAT(data["next"].dump(), HasSubstr("try --set law=asymmetric"));
  EXPECT_THAT(data["next"].dump(), HasSubstr("To identify "));
  EXPECT_THAT(std::string(data["parameters"]["caption"]), HasSubstr("Void"));
}

TEST(LogPageData, GivesTheNumbersWhereTheyPass) {
  const Tree data = DataOf(WarmRecording());
  EXPECT_TRUE(data["passed"]);
  EXPECT_TRUE(data["attachable"]);
  EXPECT_EQ(data["parameters"]["rows"][0][0], "viscous");
  EXPECT_EQ(data["parameters"]["rows"][0][1], "5.000") << "with its digits";
  EXPECT_THAT(data["agreement"].dump(), HasSubstr("1 − norm of the residual"));
}

TEST(LogPageData, GivesAssumptionsInPerCentOfEachParameterAndHidesNoughts) {
  WarmRecording warm;
  warm.estimate.assumptions = {{"cold_start", "a tenth warm", {{"coulomb", 1.2}, {"viscous", 0}}},
                               {"true_clock", "", {{"coulomb", 0.001}}}};
  const Tree table = DataOf(warm)["assumptions"];
  EXPECT_EQ(table["header"], (Tree{"taken for granted", "coulomb"})) << "nothing moves viscous";
  ASSERT_EQ(table["rows"].size(), 1u) << "0.007 % is nought";
  EXPECT_EQ(table["rows"][0][1], "+8.0 %");
}

TEST(LogPageData, HoldsNoMoreSamplesThanAPageCanCarry) {
  constexpr Eigen::Index kSamples = 100000;  // beyond some 10 000, all is thinned to what fits
  WarmRecording warm;
  Measurements& m = warm.measurements;
  RandomStream random({3, 0}, Stream::test);
  m.time = Eigen::VectorXd::LinSpaced(kSamples, 0, 1000);
  m.position = m.velocity = m.torque = m.time;
  for (Eigen::VectorXd* column : {&m.position, &m.velocity, &m.torque}) {
    for (double& value : *column) value = random.Normal();
  }
  warm.selection.keep.setConstant(kSamples, true);
  warm.selection.segments = {{0, kSamples, 1.0}};
  const Tree data = LogPageData({warm.View(), {}, {}});
  EXPECT_TRUE(data["thinned"]);
  EXPECT_LT(data["samples"].size(), 30000u);
  double highest = 0;
  for (const Tree& sample : data["samples"]) {
    highest = std::max(highest, sample[3].get<double>());
  }
  EXPECT_NEAR(highest, m.torque.maxCoeff(), 1e-3) << "no extreme is lost";
}

}  // namespace
}  // namespace warmjoint::figures
