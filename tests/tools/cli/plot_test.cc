// Pictures and reports as the program writes them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "tests/tools/cli/in_a_folder.h"
#include "tests/tools/cli/little_files.h"
#include "tools/figures/figure.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

/// Six realizations of two identifiers, one of which iterates.
std::string SuiteText() {
  return TableOneSuite(6,
                       "  - {name: energy-ml}\n"
                       "  - {name: energy-als, options: {iterations: 20}}\n"
                       "  - {name: nominal-ls}\n");
}

/// The bytes of every file of a folder, by name.
std::map<std::string, std::string> FilesOf(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    files[entry.path().filename()] = ReadWholeFile(entry.path());
  }
  return files;
}

std::vector<std::string> NamesOf(const std::map<std::string, std::string>& files) {
  std::vector<std::string> names;
  for (const auto& [name, bytes] : files) names.push_back(name);
  return names;
}

using Plot = InAFolder;
using Compare = InAFolder;
using Report = InAFolder;

// one test, because a run and its pictures take seconds
TEST_F(Plot, DrawsARunToTheSameBytesBesideTheNumbersOfCompare) {
  WriteWholeFile(at("suite.yaml"), SuiteText());
  Call({"run", at("suite.yaml"), "-o", at("run")});
  const std::string said = Call({"plot", at("run"), "-o", at("once")}).out;
  Call({"plot", at("run"), "-o", at("twice")});
  Call({"report", at("run")});

  // the same bytes again, in the report too
  const auto once = FilesOf(at("once")), twice = FilesOf(at("twice"));
  EXPECT_THAT(NamesOf(once), UnorderedElementsAre("npe_boxes.png", "error_by_iteration.png",
                                                  "parameters_by_iteration.png", "agreement.png",
                                                  "coverage.png", "parameter_pairs.png"));
  const std::string page = ReadWholeFile(at("run/report.html"));
  for (const auto& [name, bytes] : once) {
    EXPECT_TRUE(bytes == twice.at(name)) << name;
    EXPECT_NE(page.find(figures::Picture::Base64(bytes)), std::string::npos)
        << name << " in the report";
  }

  // what one sees, on stdout and in the file
  const std::string line = "npe_boxes.png: ";
  const std::size_t begin = said.find(line) + line.size();
  const std::string finding = said.substr(begin, said.find('\n', begin) - begin);
  EXPECT_THAT(finding, HasSubstr("Median NPE: energy-ml "));
  EXPECT_THAT(once.at("npe_boxes.png"), HasSubstr(finding));

  // the numbers of compare
  const std::string open = "id=\"board\">";
  const std::size_t board = page.find(open) + open.size();
  const auto held =
      nlohmann::json::parse(page.substr(board, page.find("</script>", board) - board));
  const ProgramAnswer compared = Call({"compare", at("run"), "--format", "json"});
  EXPECT_EQ(held, nlohmann::json::parse(compared.out));
}

TEST_F(Plot, DrawsWhatASimulationAndItsEstimateTell) {
  WriteWholeFile(at("warm.yaml"), TableOneYaml(1800));
  Call({"simulate", at("warm.yaml"), "-o", at("warm")});
  Call({"identify", at("warm/recording.csv"), "--identifier", "energy-ml", "-o",
        at("estimate.json"), "--plot", at("fit.png")});
  const ProgramAnswer plotted = Call({"plot", at("warm"), at("estimate.json"), "-o", at("both")});
  EXPECT_THAT(NamesOf(FilesOf(at("both/warm"))), UnorderedElementsAre("envelope.png"));
  const auto files = FilesOf(at("both/estimate"));
  EXPECT_THAT(
      NamesOf(files),
      UnorderedElementsAre("fit.png", "log.png", "predicted.png", "held_out.png", "hysteresis.png",
                           "friction_curve.png", "warm_up.png", "trace.png", "envelope.png"));
  // what the page of --plot says is what is said of it here
  const std::size_t begin = plotted.out.find("energy-ml: the numbers");
  const std::string finding = plotted.out.substr(begin, plotted.out.find('\n', begin) - begin);
  EXPECT_THAT(ReadWholeFile(at("fit.png")), HasSubstr(finding));
}

TEST_F(Plot, DrawsTheFigureThatThePaperNumbersInTheFormatAsked) {
  for (const char* format : {"png", "svg", "pdf"}) {
    Call({"plot", "kernels", "--figure", "3", "--format", format, "--style", "paper", "--size",
          "180", "--title", "none", "--data", "-o", at(format)});
    EXPECT_THAT(NamesOf(FilesOf(at(format))),
                UnorderedElementsAre("kernels.csv", std::string("kernels.") + format));
  }
  EXPECT_THAT(FilesOf(at("svg")).at("kernels.csv"), HasSubstr("panel,series,kind,x,y"));

  const ProgramAnswer other = RunWarmjoint({"plot", "kernels", "--figure", "9", "-o", at("other")});
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, HasSubstr("figure 9 of the paper (motor_fit) needs an estimate with a map "
                                   "over the motor's angle; this source gives: kernels"));
  EXPECT_EQ(RunWarmjoint({"plot", "kernels", "--size", "5x5", "-o", at("other")}).status, 2);
  EXPECT_EQ(RunWarmjoint({"plot", "kernels", "--figure", "3", "--size", "20x20", "-o", at("named")})
                .status,
            2)
      << "it has no room";
  // without a name it is left out, and told
  const ProgramAnswer small =
      RunWarmjoint({"plot", "kernels", "--size", "20x20", "-o", at("small")});
  EXPECT_EQ(small.status, 0);
  EXPECT_THAT(small.err, HasSubstr("kernels: left out: 'kernels' is too small"));
  EXPECT_TRUE(fs::is_empty(at("small")));
  EXPECT_FALSE(fs::exists(at("other")));
}

TEST_F(Plot, RefusesWhatIsNoSourceAndLeavesNothingBehind) {
  const ProgramAnswer answer = RunWarmjoint({"plot", at("nothing"), "-o", at("pictures")});
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.err, HasSubstr(at("nothing")));
  EXPECT_FALSE(fs::exists(at("pictures")));
}

TEST_F(Plot, WritesNoDataOverARecording) {
  WriteRecordingFile(at("log.csv"), 480, [](int i) { return (i / 30 % 2 ? -0.4 : 0.4); });
  const std::string before = ReadWholeFile(at("log.csv"));
  RunWarmjoint({"identify", at("log.csv"), "-o", at("e.json")});
  const ProgramAnswer answer =
      RunWarmjoint({"plot", at("e.json"), "-o", at(""), "--figure", "log", "--data"});
  EXPECT_EQ(answer.status, 2);
  EXPECT_EQ(ReadWholeFile(at("log.csv")), before);
}

TEST_F(Compare, KeepsNoticesToItselfWhereAsked) {
  WriteWholeFile(at("suite.yaml"), TableOneSuite(1, "  - {name: nominal-ls}\n"));
  Call({"run", at("suite.yaml"), "-o", at("run")});
  WriteWholeFile(at("run/suite.yaml"), "name: other\n");
  EXPECT_THAT(Call({"compare", at("run")}).err, HasSubstr("suite.yaml"));
  EXPECT_EQ(Call({"compare", at("run"), "--quiet"}).err, "");
}

TEST_F(Report, RefusesWhatItCannotTakeBeforeItIsMade) {
  WriteWholeFile(at("suite.yaml"), TableOneSuite(1, "  - {name: nominal-ls}\n"));
  Call({"run", at("suite.yaml"), "-o", at("run")});
  const std::string before = ReadWholeFile(at("run/results.sqlite"));
  EXPECT_EQ(RunWarmjoint({"report", at("run"), "-o", at("run/results.sqlite")}).status, 2);
  EXPECT_EQ(ReadWholeFile(at("run/results.sqlite")), before);
  for (const char* option : {"--gear", "--trim", "--identifier"}) {
    const ProgramAnswer answer = RunWarmjoint({"report", at("run"), option, "2"});
    EXPECT_EQ(answer.status, 2);
    EXPECT_THAT(answer.err, HasSubstr(option));
  }
}

}  // namespace
}  // namespace warmjoint
