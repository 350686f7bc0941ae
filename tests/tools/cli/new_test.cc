// Templates run as they stand.
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "tests/tools/cli/run_program.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

class New : public testing::Test {
 protected:
  ProgramAnswer Program(const std::vector<std::string>& arguments) const {
    return RunWarmjoint(arguments, {scratch_.path(), {}});
  }
  nlohmann::json Json(const std::vector<std::string>& arguments) const {
    return nlohmann::json::parse(Program(arguments).out);
  }

  ScratchDirectory scratch_;
};

TEST_F(New, ScenarioCanBeSimulatedAndIdentified) {
  ASSERT_EQ(Program({"new", "scenario", "mine"}).status, 0);
  const ProgramAnswer simulated = Program({"simulate", "mine.yaml", "-o", "mine"});
  ASSERT_EQ(simulated.status, 0) << simulated.err;
  const auto estimate = Json({"identify", "mine/recording.csv", "--format", "json"});
  EXPECT_EQ(estimate.at("status"), "ok") << estimate.at("message");
  // the truth of the template lies in the interval of its one realization
  const auto interval = estimate.at("parameters").at("viscous").at("interval95");
  EXPECT_LT(interval.at(0), 5.0);
  EXPECT_GT(interval.at(1), 5.0);
}

TEST_F(New, SuiteCanBeRun) {
  ASSERT_EQ(Program({"new", "suite", "my_ladder"}).status, 0);
  const ProgramAnswer run =
      Program({"run", "my_ladder.yaml", "-o", "run", "--realizations", "2", "--jobs", "1"});
  ASSERT_EQ(run.status, 0) << run.err;
  const auto board = Json({"compare", "run", "--format", "json"});
  EXPECT_EQ(board.at("suite"), "my_ladder");
  EXPECT_EQ(board.at("rows").size(), 3u);
}

TEST_F(New, IdentifierAnswersInPlainPython) {
  const std::string python = "/usr/bin/python3";  // what the sandbox of commands lets through
  if (!std::filesystem::exists(python)) GTEST_SKIP() << python << " is absent";
  ASSERT_EQ(Program({"new", "identifier", "mine"}).status, 0);
  const ProgramAnswer run = Program(
      {"run", "table1", "-o", "run", "--realizations", "1", "--identifier",
       "mine=" + python + " ./mine.py {recording} {estimate}", "--identifier", "nominal-ls"});
  ASSERT_EQ(run.status, 0) << run.err;
  // the same least squares as ours: the same figures
  const auto rows = Json({"compare", "run", "--format", "json"}).at("rows");
  ASSERT_EQ(rows.size(), 2u);
  const double first = rows.at(0).at("npe").at("continuous").at("median");
  const double second = rows.at(1).at("npe").at("continuous").at("median");
  EXPECT_NEAR(first, second, 0.1 * first) << "samples at rest and switches may be taken otherwise";
}

TEST_F(New, LeavesWhatIsThere) {
  WriteWholeFile(scratch_.path() / "mine.yaml", "thesis");
  EXPECT_EQ(Program({"new", "suite", "mine"}).status, 2);
  EXPECT_EQ(ReadWholeFile(scratch_.path() / "mine.yaml"), "thesis");
}

}  // namespace
}  // namespace warmjoint
