// Help, lists, completion and templates.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "models/foundation/atomic_file.h"
#include "tests/support/folders.h"
#include "tests/tools/cli/in_a_folder.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

using CommandLine = InAFolder;

TEST_F(CommandLine, HelpAndVersionEndWell) {
  const std::string help = Call({"--help"}).out;
  for (const char* name : {"list", "simulate", "check", "identify", "run", "compare"}) {
    EXPECT_THAT(help, HasSubstr(name));
    Call({name, "--help"});
  }
  Call({"--version"});
}

TEST_F(CommandLine, ListsEveryFamilyAsTextAndJson) {
  for (const char* family : {"laws", "identifiers", "robots", "library", "suites"}) {
    const auto members = nlohmann::json::parse(Call({"list", family, "--format", "json"}).out);
    EXPECT_FALSE(members.empty()) << family;
    const std::string text = Call({"list", family}).out;
    for (const auto& member : members) {
      EXPECT_THAT(text, HasSubstr(member.at("name").get<std::string>()));
    }
  }
  EXPECT_THAT(Call({"list", "laws"}).out, HasSubstr("coulomb_positive")) << "its parameters";
}

TEST_F(CommandLine, ListsOptionsOfIdentifiers) {
  for (const auto& identifier : Json({"list", "identifiers"})) {
    for (const auto& option : identifier.at("options")) {
      for (const char* key : {"name", "default", "allowed", "meaning"}) {
        EXPECT_TRUE(option.at(key).is_string()) << identifier.at("name") << " " << key;
      }
    }
  }
}

/// What bash offers for the last word of a command line: its words as bash parts them.
std::vector<std::string> Offers(const std::vector<std::string>& words) {
  const std::string script = test::SourceFolder() / "tools/cli/completion.bash";
  std::string line =
      "source " + script + "; COMP_WORDS=('" + (test::BuildFolder() / "warmjoint").string() + "' ";
  for (const std::string& word : words) line += "'" + word + "' ";
  line += "); COMP_CWORD=" + std::to_string(words.size());
  line += "; _warmjoint; echo \"${COMPREPLY[@]}\"";
  const ProgramAnswer answer = RunCommandLine({"bash", "--norc", "-c", line});
  EXPECT_EQ(answer.err, "");
  std::istringstream offers(answer.out);
  return {std::istream_iterator<std::string>(offers), {}};
}

TEST(Completion, OffersWhatFits) {
  using testing::UnorderedElementsAreArray;
  using Words = std::vector<std::string>;
  const std::pair<Words, Words> cases[]{
      {{"id"}, {"identify", "identify-robot"}},
      {{"--ver"}, {"--version"}},
      {{"run", "--re"}, {"--realizations"}},
      {{"check", "log.csv", "--seg"}, {"--segments"}},
      {{"check", "log.csv", "--real"}, {}},
      {{"check", "log.csv", "--joint", ""}, {"rotary", "linear"}},
      {{"check", "log.csv", "--joint", "=", "l"}, {"linear"}},
      {{"check", "log.csv", "--joint", "="}, {"rotary", "linear"}},
      {{"-q", "predict", "e.json", "log.csv", "--initial", ""}, {"cold", "end"}},
      {{"plot", "runs", "--figure", ""}, {}},
      {{"list", ""}, {"laws", "identifiers", "robots", "library", "suites"}},
      {{"list", "laws", "visc"}, {"viscous_coulomb"}},
      {{"run", "tab"}, {"table1", "table1-mujoco", "table1-rests"}},
      {{"attach", "pend"}, {"pendulum"}},
      {{"identify", "log.csv", "--identifier", "energy-al"}, {"energy-als"}},
      {{"identify", "log.csv", "--set", "law", "=", "visc"}, {"viscous_coulomb"}},
      {{"check", "lo"}, {}},  // bash offers files where nothing else is
  };
  for (const auto& [words, offers] : cases) {
    EXPECT_THAT(Offers(words), UnorderedElementsAreArray(offers)) << testing::PrintToString(words);
  }
}

using New = InAFolder;

TEST_F(New, ScenarioCanBeSimulatedAndIdentified) {
  Call({"new", "scenario", "mine"});
  Call({"simulate", "mine.yaml", "-o", "mine"});
  const auto estimate = Json({"identify", "mine/recording.csv"});
  EXPECT_EQ(estimate.at("status"), "ok") << estimate.at("message");
  // the truth of the template lies in the interval of its one realization
  const auto interval = estimate.at("parameters").at("viscous").at("interval95");
  EXPECT_LT(interval.at(0), 5.0);
  EXPECT_GT(interval.at(1), 5.0);
}

TEST_F(New, MachineIsARecipeWithItsEntries) {
  Call({"new", "machine", "mine"});
  const std::string recipe = File("mine.toml");
  for (const char* entry : {"machine = ", "[[source]]", "licence = ", "[[run]]", "command = "}) {
    EXPECT_THAT(recipe, HasSubstr(entry));
  }
}

TEST_F(CommandLine, RobotsSayThatTheirFrictionIsInvented) {
  for (const auto& robot : Json({"list", "robots"}))
    EXPECT_EQ(robot.at("friction").at("origin"), "invented");
  EXPECT_THAT(Call({"list", "robots"}).out, HasSubstr("invented"));
}

TEST_F(New, SuiteCanBeRun) {
  Call({"new", "suite", "my_ladder"});
  Call({"run", "my_ladder.yaml", "-o", "run", "--realizations", "2", "--jobs", "1"});
  const auto board = Json({"compare", "run"});
  EXPECT_EQ(board.at("suite"), "my_ladder");
  EXPECT_EQ(board.at("rows").size(), 3u);
}

TEST_F(New, IdentifierAnswersInPlainPython) {
  const std::string python = "/usr/bin/python3";  // what the sandbox of commands lets through
  if (!std::filesystem::exists(python)) GTEST_SKIP() << python << " is absent";
  Call({"new", "identifier", "mine"});
  Call({"run", "table1", "-o", "run", "--realizations", "1", "--identifier",
        "mine=" + python + " ./mine.py {recording} {estimate}", "--identifier", "nominal-ls"});
  // the same least squares as ours: the same figures
  const auto rows = Json({"compare", "run"}).at("rows");
  ASSERT_EQ(rows.size(), 2u);
  const double first = rows.at(0).at("npe").at("continuous").at("median");
  const double second = rows.at(1).at("npe").at("continuous").at("median");
  EXPECT_NEAR(first, second, 0.1 * first) << "samples at rest and switches may be taken otherwise";
}

TEST_F(New, LeavesWhatIsThere) {
  WriteWholeFile(at("mine.yaml"), "thesis");
  Refusal({"new", "suite", "mine"});
  EXPECT_EQ(File("mine.yaml"), "thesis");
}

}  // namespace
}  // namespace warmjoint
