// The pages of a run and of a log.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <regex>

#include "identification/identifiers/identifier_list.h"
#include "identification/lack_of_fit/table.h"
#include "scenarios/suite.h"
#include "tests/tools/report/look.h"
#include "tests/tools/report/run_example.h"
#include "tests/tools/report/warm_recording.h"
#include "tools/board/board_tables.h"
#include "tools/board/format_board.h"
#include "tools/report/page/chart_library.h"
#include "tools/report/page/html.h"
#include "tools/report/page/log_page.h"
#include "tools/report/page/plain_words.h"
#include "tools/report/page/realization_list.h"
#include "tools/report/page/run_page.h"
#include "tools/report/page/run_words.h"
#include "tools/report/page/style.h"
#include "tools/report/run/run_figures.h"

namespace warmjoint::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

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
  row.npe_continuous = {0.011, 0.009, 0.013, 0.0121};
  row.npe_discrete = row.npe_continuous;
  row.rmse = {0.5, 0.49, 0.51, 0.5};
  board.rows = {row};
  return board;
}

const std::string& ExamplePage() {
  static const std::string page = [] {
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
    return MakeRunPage(example);
  }();
  return page;
}

/// The page with its pictures' bytes cut out.
std::string ExampleMarkup() {
  std::string page = ExamplePage();
  const std::string mark = "base64,";
  for (std::size_t at = page.find(mark); at != std::string::npos; at = page.find(mark, at + 1)) {
    const std::size_t begin = at + mark.size();
    page.erase(begin, page.find('"', begin) - begin);
  }
  return page;
}

int Count(const std::string& text, const std::string& what) {
  int count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
    ++count;
  }
  return count;
}

TEST(RunPage, AsksNothingOfAnyServer) {
  const std::string page = ExampleMarkup();
  EXPECT_EQ(Count(page, "http:") + Count(page, "https:"), 0);
  EXPECT_EQ(Count(page, "@import"), 0);
  EXPECT_EQ(Count(page, "url("), 0);
  // every source and link stays in the page
  const std::regex reference(R"re((?:src|srcset|href)="([^"]{0,12}))re");
  for (std::sregex_iterator it(page.begin(), page.end(), reference), end; it != end; ++it) {
    const std::string target = (*it)[1];
    EXPECT_TRUE(target.starts_with("data:") || target.starts_with("#")) << target;
  }
}

TEST(RunPage, SaysQuestionVerdictNotesAndHowToRepeatIt) {
  const std::string& page = ExamplePage();
  EXPECT_THAT(page, HasSubstr("Which one is right &amp; why?"));
  EXPECT_THAT(page, HasSubstr(Escape(InPrint(Verdict(ExampleBoard())))));
  EXPECT_THAT(page, HasSubstr("it &lt;b&gt;moved&lt;/b&gt;"));
  EXPECT_THAT(page, HasSubstr("warmjoint run suite.yaml"));
  EXPECT_THAT(page, HasSubstr("name: table1"));
}

TEST(RunPage, LetsItsOwnScriptRunAlone) {
  const std::string& page = ExamplePage();
  EXPECT_EQ(Count(page, SecurityPolicy({kStyle, RealizationStyle()}, {RealizationScript()})), 1);
  EXPECT_EQ(Count(page, "<script>" + std::string(RealizationScript()) + "</script>"), 1);
}

TEST(RunPage, EscapesWhatOthersWrote) {
  EXPECT_THAT(ExamplePage(), Not(HasSubstr("table1 <script>")));
  EXPECT_EQ(Escape("<a href=\"x\">'&'</a>"),
            "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;&lt;/a&gt;");
}

TEST(RunPage, HoldsTheNumbersOfCompare) {
  const std::string& page = ExamplePage();
  // for people: the cells of the ranking
  const warmjoint::Table ranking = RankingTable(ExampleBoard());
  for (const std::string& cell : ranking.rows[0]) {
    EXPECT_THAT(page, HasSubstr(">" + Escape(InPrint(cell)) + "</t"));
  }
  // for programs: the same JSON
  const std::string open = "id=\"board\">";
  const std::size_t begin = page.find(open) + open.size();
  const std::string json = page.substr(begin, page.find("</script>", begin) - begin);
  EXPECT_EQ(nlohmann::json::parse(json), nlohmann::json::parse(BoardToJson(ExampleBoard())));
}

TEST(RunPage, GivesEveryPictureAnAltTextAndBothThemes) {
  const std::string& page = ExamplePage();
  EXPECT_EQ(Count(page, "<img "), 1);
  EXPECT_THAT(page, HasSubstr("alt=\"Parameter error of each identifier. Median NPE: energy-ml"));
  EXPECT_EQ(Count(page, "media=\"(prefers-color-scheme: dark)\" srcset=\"data:image/png"), 1);
}

TEST(RunPage, ClosesEveryElementThatItOpens) {
  const std::string page = ExampleMarkup();
  const std::regex tag(R"(<(/?)([a-z0-9]+)[^>]*>)");
  std::vector<std::string> open;
  // text inside quotes is escaped and holds no ">"
  for (std::sregex_iterator it(page.begin(), page.end(), tag), end; it != end; ++it) {
    const std::string name = (*it)[2];
    if (name == "meta" || name == "link" || name == "img" || name == "source") continue;
    if ((*it)[1].length() == 0) {
      open.push_back(name);
    } else {
      ASSERT_FALSE(open.empty());
      ASSERT_EQ(open.back(), name);
      open.pop_back();
    }
  }
  EXPECT_TRUE(open.empty());
}

TEST(Base64, EncodesTheVectorsOfRfc4648) {
  EXPECT_EQ(Base64(""), "");
  EXPECT_EQ(Base64("f"), "Zg==");
  EXPECT_EQ(Base64("fo"), "Zm8=");
  EXPECT_EQ(Base64("foo"), "Zm9v");
  EXPECT_EQ(Base64("foobar"), "Zm9vYmFy");
}

std::string PageOf(const WarmRecording& warm) {
  return MakeLogPage({MakeFitView(warm.measurements, warm.selection, warm.estimate),
                      CheckRecording(warm.measurements),
                      {"warmjoint identify warm.csv"}});
}

TEST(LogPage, SaysWhyALogWasRefusedAndWhatToRecord) {
  WarmRecording warm;
  warm.estimate.status = Status::inadequate_model;
  warm.estimate.message = "the residual depends on direction <3 N.m>";
  Diagnostic direction;
  direction.test = "direction";
  direction.made = direction.rejected = true;
  direction.effect = 3;
  direction.effect_unit = "N.m";
  warm.estimate.diagnostics = {direction};
  const std::string page = PageOf(warm);
  EXPECT_THAT(page, HasSubstr("the model does not describe these data: do not use the numbers"));
  EXPECT_THAT(page, HasSubstr("The residual depends on direction &lt;3 N·m&gt;."));
  EXPECT_THAT(page, HasSubstr("Do forward and backward motion leave different residuals?"));
  EXPECT_THAT(page, HasSubstr("try --set law=asymmetric"));
  EXPECT_THAT(page, HasSubstr("Void: parameters of a fit that failed"));
  EXPECT_THAT(page, HasSubstr("A void fit belongs into no simulation"));
  EXPECT_THAT(page, HasSubstr("To identify "));
}

TEST(LogPage, ShowsTheWayIntoMuJoCoWhereTheNumbersPass) {
  const std::string page = PageOf(WarmRecording());
  EXPECT_THAT(page, HasSubstr("warmjoint attach robot.xml --joint JOINT=estimate.json"));
  EXPECT_THAT(page, Not(HasSubstr("Void: ")));
  EXPECT_THAT(page, HasSubstr(">5.000</td>")) << "the viscous friction, with its digits";
}

TEST(LogPage, AsksNothingOfAnyServerAndIsTheSameEachTime) {
  const std::string page = PageOf(WarmRecording());
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  for (const char* asks : {"src=\"http", "href=\"http", "sourceMappingURL", "@import"}) {
    EXPECT_THAT(page, Not(HasSubstr(asks)));
  }
  EXPECT_THAT(page, HasSubstr("MIT")) << "the licence of what is inside";
  EXPECT_TRUE(page == PageOf(WarmRecording()));
}

TEST(LogPage, StaysBelowSixMegabytesHoweverLongTheLog) {
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
  const FitView view = MakeFitView(m, warm.selection, warm.estimate);
  EXPECT_LT(MakeLogPage({view, {}, {}}).size(), 6000000u);
}

}  // namespace
}  // namespace warmjoint::report
