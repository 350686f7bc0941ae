// Pictures and reports as the program writes them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "tests/tools/cli/in_a_folder.h"
#include "tests/tools/cli/little_files.h"

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

std::vector<std::string> NamesOf(const std::map<std::string, std::string>& files) {
  std::vector<std::string> names;
  for (const auto& [name, bytes] : files) names.push_back(name);
  return names;
}

using Plot = InAFolder;

// one test, because a run and its pictures take seconds
TEST_F(Plot, DrawsARunToTheSameBytesBesideTheNumbersOfCompare) {
  WriteWholeFile(at("suite.yaml"), SuiteText());
  Call({"run", "suite.yaml", "-o", "run"});
  const std::string said = Call({"plot", "run", "-o", "once"}).out;
  Call({"plot", "run", "-o", "twice"});
  Call({"report", "run"});

  // the same bytes again; the report holds each picture, in colours for both kinds of screen
  const auto once = FilesOf("once"), twice = FilesOf("twice");
  EXPECT_THAT(NamesOf(once), UnorderedElementsAre("npe_boxes.png", "error_by_iteration.png",
                                                  "parameters_by_iteration.png", "agreement.png",
                                                  "coverage.png", "parameter_pairs.png"));
  const std::string page = File("run/report.html");
  for (const auto& [name, bytes] : once) {
    EXPECT_TRUE(bytes == twice.at(name)) << name;
    EXPECT_THAT(page, HasSubstr("<figure id=\"" + name.substr(0, name.find('.')) + "\">"));
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
  EXPECT_EQ(held, Json({"compare", "run"}));

  // a report goes onto no store, and takes no option of a log
  const std::string before = File("run/results.sqlite");
  Refusal({"report", "run", "-o", "run/results.sqlite"});
  EXPECT_EQ(File("run/results.sqlite"), before);
  for (const char* option : {"--gear", "--trim", "--identifier"}) {
    EXPECT_THAT(Refusal({"report", "run", option, "2"}), HasSubstr(option));
  }
}

TEST_F(Plot, DrawsWhatASimulationAndItsEstimateTell) {
  WriteWholeFile(at("warm.yaml"), TableOneYaml(1800));
  Call({"simulate", "warm.yaml", "-o", "warm"});
  Call({"identify", "warm/recording.csv", "--identifier", "energy-ml", "-o", "estimate.json",
        "--plot", "fit.png"});
  const ProgramAnswer plotted = Call({"plot", "warm", "estimate.json", "-o", "both"});
  EXPECT_THAT(NamesOf(FilesOf("both/warm")), UnorderedElementsAre("envelope.png"));
  EXPECT_THAT(
      NamesOf(FilesOf("both/estimate")),
      UnorderedElementsAre("fit.png", "log.png", "predicted.png", "held_out.png", "hysteresis.png",
                           "friction_curve.png", "warm_up.png", "trace.png", "envelope.png"));
  // what the page of --plot says is what is said of it here
  const std::size_t begin = plotted.out.find("energy-ml: the numbers");
  const std::string finding = plotted.out.substr(begin, plotted.out.find('\n', begin) - begin);
  EXPECT_THAT(File("fit.png"), HasSubstr(finding));
}

TEST_F(Plot, DrawsTheFigureThatThePaperNumbersInTheFormatAsked) {
  for (const char* format : {"png", "svg", "pdf"}) {
    Call({"plot", "kernels", "--figure", "3", "--format", format, "--style", "paper", "--size",
          "180", "--title", "none", "--data", "-o", format});
    EXPECT_THAT(NamesOf(FilesOf(format)),
                UnorderedElementsAre("kernels.csv", std::string("kernels.") + format));
  }
  EXPECT_THAT(File("svg/kernels.csv"), HasSubstr("panel,series,kind,x,y"));

  // what has no room is refused by its name; without a name it is left out, and told
  EXPECT_THAT(Refusal({"plot", "kernels", "--figure", "3", "--size", "20x20", "-o", "named"}),
              HasSubstr("'kernels' is too small"));
  EXPECT_FALSE(fs::exists(at("named")));
  EXPECT_THAT(Call({"plot", "kernels", "--size", "20x20", "-o", "small"}).err,
              HasSubstr("kernels: left out: 'kernels' is too small"));
  EXPECT_TRUE(fs::is_empty(at("small")));
}

TEST_F(Plot, WritesNoDataOverARecording) {
  WriteRecordingFile(at("log.csv"), 480, [](int i) { return (i / 30 % 2 ? -0.4 : 0.4); });
  const std::string before = File("log.csv");
  Program({"identify", "log.csv", "-o", "e.json"});
  Refusal({"plot", "e.json", "-o", at(""), "--figure", "log", "--data"});
  EXPECT_EQ(File("log.csv"), before);
}

}  // namespace
}  // namespace warmjoint
