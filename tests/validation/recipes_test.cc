// The recipes of tools/docs/real-logs.md for logs of others, from their files to a verdict.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "tests/support/shared_data.h"
#include "tests/tools/cli/run_program.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

/// Runs tools/examples/<script> with the arguments; its output goes to `out`.
void Convert(const std::string& script, const std::string& arguments, const std::string& out) {
  const std::filesystem::path path = test::SourceFolder() / "tools/examples" / script;
  const std::string command = fmt::format("python3 '{}' {} > '{}'", path.string(), arguments, out);
  ASSERT_EQ(std::system(command.c_str()), 0) << command;
}

TEST(Recipes, AStaubliTx40InAmperes) {
  WARMJOINT_NEED_SHARED("data/tx40/curr_data.csv");
  const ScratchDirectory scratch;
  const std::filesystem::path data = test::SharedFolder() / "data/tx40";
  const std::string log = scratch.path() / "joint4.csv", output = scratch.path() / "estimate.json";
  Convert("tx40_to_csv.py",
          fmt::format("'{}' '{}' 4", (data / "pos_read_data.csv").string(),
                      (data / "curr_data.csv").string()),
          log);

  const std::vector<std::string> reading{"--map", "torque=current", "--unit",
                                         "position=deg,torque=A"};
  std::vector<std::string> check{"check", log};
  check.insert(check.end(), reading.begin(), reading.end());
  const ProgramAnswer checked = RunWarmjoint(check);
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_THAT(checked.out, HasSubstr("45000 samples in 9 s, 5000 Hz"));
  EXPECT_THAT(checked.out, HasSubstr("no  warm-up"));

  // the unit of the current is carried through
  std::vector<std::string> identify{"identify",  log, "--identifier", "nominal-ls",
                                    "--holdout", "0", "-o",           output};
  identify.insert(identify.end(), reading.begin(), reading.end());
  RunWarmjoint(identify);
  const auto estimate = nlohmann::json::parse(ReadWholeFile(output));
  const auto& parameters = estimate.at("parameters");
  EXPECT_EQ(parameters.at("viscous").at("unit"), "A.s/rad");
  EXPECT_EQ(parameters.at("coulomb").at("unit"), "A");
  EXPECT_GT(parameters.at("viscous").at("value").get<double>(), 0);
  EXPECT_GT(parameters.at("coulomb").at("value").get<double>(), 0);
  const auto& friction = estimate.at("friction");
  EXPECT_TRUE(friction.is_null() || friction.at("torque_unit") == "A") << "MuJoCo knows no amperes";
}

TEST(Recipes, AnXl330IsFittedAsItSwings) {
  const std::string name = "data/xl330/2026-01-15_10h30m02.json";
  WARMJOINT_NEED_SHARED(name);
  const ScratchDirectory scratch;
  const std::string log = scratch.path() / "xl330.csv";
  Convert("xl330_to_csv.py", fmt::format("'{}'", (test::SharedFolder() / name).string()), log);
  // loads are signed again
  EXPECT_THAT(ReadWholeFile(log), HasSubstr(",-"));
  EXPECT_THAT(ReadWholeFile(log), testing::Not(HasSubstr(",655")));

  const std::vector<std::string> reading{log, "--map", "torque=load", "--unit", "torque=raw"};
  std::vector<std::string> check{"check"}, identify{"identify"};
  check.insert(check.end(), reading.begin(), reading.end());
  identify.insert(identify.end(), reading.begin(), reading.end());
  EXPECT_THAT(RunWarmjoint(check).out, HasSubstr("fits take motion of any kind"));
  EXPECT_EQ(RunWarmjoint(identify).status, 0);
}

}  // namespace
}  // namespace warmjoint
