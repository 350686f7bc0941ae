// Messages stay short whatever they speak of.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/foundation/atomic_file.h"
#include "tests/tools/cli/run_program.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

/// Text of any length and content that a file or an option may hold.
const std::string kLong = std::string(20000, 'x') + "\x1b[31m";

struct LongInput {
  std::string name;
  std::string file;                    // its content
  std::vector<std::string> arguments;  // FILE stands for its path
};

void PrintTo(const LongInput& input, std::ostream* stream) { *stream << input.name; }

class LongInputs : public testing::TestWithParam<LongInput> {};

TEST_P(LongInputs, AreRefusedInFewWords) {
  const ScratchDirectory scratch;
  const std::string file = scratch.path() / (GetParam().name + ".txt");
  WriteWholeFile(file, GetParam().file);
  std::vector<std::string> arguments = GetParam().arguments;
  for (std::string& argument : arguments) {
    if (const std::size_t at = argument.find("FILE"); at != std::string::npos) {
      argument.replace(at, 4, file);
    }
    if (argument == "OUT") argument = scratch.path() / "out";
  }
  const ProgramAnswer answer = RunWarmjoint(arguments);
  EXPECT_EQ(answer.status, 2);
  // the longest that is not the input's own: a list of 24 known names beside an excerpt of 60
  EXPECT_LT(answer.err.size(), 900u) << answer.err;
  EXPECT_EQ(answer.err.find('\x1b'), std::string::npos) << "controls the terminal";
  EXPECT_NE(answer.err, "");
}

const std::string kHeader = "time,position,velocity,torque\n";
const std::string kYaml = "plant: ideal\nduration: ";

std::string ManyColumns() {
  std::string header;
  for (int i = 0; i < 5000; ++i) header += "column" + std::to_string(i) + ",";
  return header + "c\n";
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, LongInputs,
    testing::Values(
        LongInput{"cell", kHeader + "0,0,1," + kLong + "\n", {"check", "FILE"}},
        LongInput{"column", kLong + ",1\n0,0\n", {"check", "FILE"}},
        LongInput{"columns", ManyColumns(), {"check", "FILE"}},
        LongInput{"mapped", kHeader, {"check", "FILE", "--map", "torque=" + kLong}},
        LongInput{"unit", kHeader, {"check", "FILE", "--unit", "torque=" + kLong}},
        LongInput{"pair", kHeader, {"check", "FILE", "--map", kLong}},
        LongInput{"value", kYaml + kLong, {"simulate", "FILE", "-o", "OUT"}},
        LongInput{"key", kLong + ": 3\n", {"simulate", "FILE", "-o", "OUT"}},
        LongInput{"word", "plant: " + kLong, {"simulate", "FILE", "-o", "OUT"}},
        LongInput{
            "setting", kYaml + "3", {"simulate", "FILE", "-o", "OUT", "--set", "seed=" + kLong}},
        LongInput{"option", kHeader, {"identify", "FILE", "--set", "law=" + kLong}},
        LongInput{"option_name", kHeader, {"identify", "FILE", "--set", kLong + "=1"}},
        LongInput{"identifier", kHeader, {"identify", "FILE", "--identifier", kLong}},
        LongInput{"argument", "", {"identify", "FILE", "--" + kLong}},
        LongInput{"subcommand", "", {kLong}},
        LongInput{"shard", "", {"run", "FILE", "-o", "OUT", "--shard", kLong}},
        LongInput{"no_json", kLong, {"attach", "pendulum", "-o", "OUT", "--joint", "hinge=FILE"}}),
    [](const auto& suite) { return suite.param.name; });

}  // namespace
}  // namespace warmjoint
