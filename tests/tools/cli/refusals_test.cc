// Wrong usages, unusable recordings and long inputs: refused in few words that name the right thing, with nothing left behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "models/foundation/atomic_file.h"
#include "tests/support/folders.h"
#include "tests/tools/cli/little_files.h"
#include "tests/tools/cli/run_program.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

namespace fs = std::filesystem;

struct WrongUsage {
  std::vector<std::string> arguments;
  std::string right;  // what the answer must name
};

/// Friction for a joint of the pendulum.
std::string Pendulum(const std::string& joint = "hinge") {
  return joint + "=" + (test::SourceFolder() / "models/robots/pendulum/friction.json").string();
}

const std::vector<WrongUsage>& WrongUsages() {
  static const std::vector<WrongUsage> usages{
      // commands
      {{}, "subcommand is required"},
      {{"idntify", "log.csv"}, "'identify'"},
      {{"comapre", "R"}, "'compare'"},
      {{"--jobs", "4", "run", "suite.yaml"}, "no '--jobs' here"},
      {{"help"}, "warmjoint --help"},
      // list
      {{"list"}, "FAMILY is required"},
      {{"list", "law"}, "'laws'"},
      {{"list", "laws", "assymetric"}, "'asymmetric'"},
      {{"list", "identifiers", "energy-mll"}, "'energy-ml'"},
      {{"list", "robots", "--format", "yaml"}, "text, json, names"},
      // recordings
      {{"check"}, "RECORDING is required"},
      {{"check", "lgo.csv"}, "lgo.csv"},
      {{"check", "log.csv", "--map", "torqe=torque"}, "'torque'"},
      {{"check", "log.csv", "--map", "torque=torqe"}, "torque"},
      {{"check", "log.csv", "--map", "torque"}, "key=value"},
      {{"check", "log.csv", "--unit", "position=dgr"}, ", deg,"},
      {{"check", "log.csv", "--unit", "torque=N.n"}, "N.m"},
      {{"check", "log.csv", "--joint", "prismatic"}, "'linear'"},
      {{"check", "log.csv", "--joint", "rotatory"}, "'rotary'"},
      {{"check", "log.csv", "--trim", "-1"}, "0 or more"},
      {{"check", "log.csv", "--gear", "ten"}, "--gear = ten"},
      {{"check", "log.csv", "--gear"}, "NUMBER"},
      {{"check", "log.csv", "--identifier", "auto"}, "no '--identifier' here"},
      {{"check", "suite.yaml"}, "time"},
      // identify
      {{"identify", "log.csv", "--identifier", "energyml"}, "'energy-ml'"},
      {{"identify", "log.csv", "--identifier", "energy-ml", "--set", "lw=coulomb"}, "'law'"},
      {{"identify", "log.csv", "--set", "law=coulomb"}, "energy-ml"},
      {{"identify", "log.csv", "--identifier", "energy-ml", "--set", "law=asymetric"},
       "'asymmetric'"},
      {{"identify", "log.csv", "--gravity", "sin"}, "'sincos'"},
      {{"identify", "log.csv", "--start", "warm"}, "'unknown'"},
      {{"identify", "log.csv", "--holdout", "2"}, "below 1"},
      {{"identify", "log.csv", "--relevance", "5"}, "at most 1"},
      {{"identify", "log.csv", "-o", "no/such/e.json"}, "no/such"},
      {{"identify", "log.csv", "-o", "log.csv"}, "another output"},
      {{"identify", "log.csv", "--format", "yaml"}, "text, json"},
      {{"identify", "log.csv", "--explian"}, "'--explain'"},
      // scenarios
      {{"simulate", "-o", "d"}, "SCENARIO"},
      {{"simulate", "scenari.yaml", "-o", "d"}, "scenari.yaml"},
      {{"simulate", "scenario.yaml"}, "--output is required"},
      {{"simulate", "scenario.yaml", "-o", "d", "--set", "noise.torqe=1"}, "'torque'"},
      {{"simulate", "scenario.yaml", "-o", "d", "--set", "noise.torque=loud"}, "number"},
      {{"simulate", "scenario.yaml", "-o", "d", "--set", "plant=mujocco"}, "mujoco"},
      {{"simulate", "scenario.yaml", "-o", "d", "--seed", "-1"}, "from 0"},
      {{"simulate", "scenario.yaml", "-o", "d", "--format", "hdf5"}, "'h5'"},
      // suites
      {{"run", "tabel1", "-o", "d"}, "'table1'"},
      {{"run", "table1.yml", "-o", "d"}, "'table1'"},
      {{"run", "suite.yaml"}, "--output is required"},
      {{"run", "suite.yaml", "-o", "d", "--jobs", "0"}, "from 1 to 1024"},
      {{"run", "suite.yaml", "-o", "d", "--realizations", "1.5"}, "whole number"},
      {{"run", "suite.yaml", "-o", "d", "--identifier", "nominalls"}, "'nominal-ls'"},
      {{"run", "suite.yaml", "-o", "d", "--shard", "3/2"}, "3/2"},
      {{"run", "suite.yaml", "-o", "d", "--slurm", "--local-shards", "2"}, "not both"},
      {{"compare", "nothing"}, "no run directory"},
      {{"compare", "nothing", "--format", "markdwon"}, "'markdown'"},
      {{"report", "log.csv"}, "log.csv"},
      {{"report", "log.csv", "-o", "log.csv"}, "is an input too"},
      {{"merge", "a", "b"}, "-o"},
      {{"status", "nothing"}, "nothing"},
      {{"plot", "nothing", "-o", "d"}, "nothing"},
      // robots
      {{"attach", "pendulm", "--joint", "hinge=f.json", "-o", "d.xml"}, "'pendulum'"},
      {{"attach", "pendulum", "--joint", "hinge", "-o", "d.xml"}, "NAME=FILE"},
      {{"attach", "pendulum", "--joint", "hinge=f.json", "-o", "d.xml", "--as", "pasive"},
       "'passive'"},
      {{"attach", "pendulum", "--joint", Pendulum("hing"), "-o", "d.xml"}, "'hinge'"},
      {{"attach", "pendulum", "--joint", Pendulum(), "-o", "d.xml", "--armature", "hinge=-1"},
       "0 or more"},
      {{"attach", "pendulum", "--joint", Pendulum(), "-o", "d.xml", "--armature", "hing=1"},
       "'hinge'"},
      {{"attach", "pendulum", "--joint", Pendulum(), "-o", "d.xml", "--timestep", "0"}, "above 0"},
      {{"attach", "pendulum", "--joint", Pendulum(), "-o", "d.xml", "--integrator", "RK45"}, "RK4"},
      {{"attach", "pendulum", "--joint", Pendulum(), "-o", "d.xml", "--package", "rd=/none"},
       "not a folder"},
      {{"attach", "pendulum", "--joint", Pendulum(), "-o", "d.xml", "--initial", "hot"}, "settled"},
      {{"attach", "pendulum", "--joint", Pendulum(), "-o", "d.xml", "--initial", "settled:fast"},
       "rad/s"},
      {{"attach", "pendulum", "--joint", Pendulum(), "-o", "d.xml", "--initial", "end"},
       "state_end"},
      {{"attach", "pendulum", "--joint", Pendulum(), "--joint", Pendulum(), "-o", "d.xml"},
       "twice"},
      {{"predict", Pendulum().substr(Pendulum().find('=') + 1), "log.csv", "--initial", "warm"},
       "settled:SPEED"},
      // templates
      {{"new", "scenari", "mine"}, "'scenario'"},
      {{"new", "scenario", "a/b"}, "letters"},
      {{"new", "scenario", "scenario"}, "exists"},
  };
  return usages;
}

std::set<std::string> Holdings(const fs::path& folder) {
  std::set<std::string> holdings;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    std::string bytes = entry.is_regular_file() ? ReadWholeFile(entry.path()) : "";
    holdings.insert(entry.path().string() + ":" + bytes);
  }
  return holdings;
}

TEST(WrongUsage, IsToldBrieflyWithTheNearestRightThing) {
  ASSERT_GE(WrongUsages().size(), 40u);
  const ScratchDirectory scratch;
  WriteRecordingFile(scratch.path() / "log.csv", 200,
                     [](int i) { return (i / 20 % 2 ? -1 : 1) * (i / 40 % 2 ? 0.5 : 1.0); });
  WriteWholeFile(scratch.path() / "scenario.yaml", TableOneYaml(60));
  WriteWholeFile(scratch.path() / "suite.yaml", TableOneSuite(1, "  - {name: nominal-ls}\n"));
  const std::set<std::string> before = Holdings(scratch.path());

  for (const WrongUsage& usage : WrongUsages()) {
    std::string typed = "warmjoint";
    for (const std::string& argument : usage.arguments) typed += " " + argument;
    const ProgramAnswer answer = RunWarmjoint(usage.arguments, {scratch.path(), {}});
    EXPECT_EQ(answer.status, 2) << typed;
    EXPECT_EQ(answer.out, "") << typed;
    EXPECT_THAT(answer.err, testing::HasSubstr(usage.right)) << typed;
    EXPECT_LE(answer.err.size(), 300u) << typed << "\n" << answer.err;
    EXPECT_EQ(Holdings(scratch.path()), before) << typed;
  }
}

struct BadRecording {
  std::string name;
  std::string text;
  std::string message;  // part of what must be said
};

void PrintTo(const BadRecording& recording, std::ostream* stream) { *stream << recording.name; }

class BadRecordings : public testing::TestWithParam<BadRecording> {};

TEST_P(BadRecordings, AreRefusedAndLeaveNothingBehind) {
  const ScratchDirectory scratch;
  const std::string recording = scratch.path() / "log.csv";
  WriteWholeFile(recording, GetParam().text);

  const ProgramAnswer check = RunWarmjoint({"check", recording});
  EXPECT_EQ(check.status, 2);
  EXPECT_THAT(check.err, HasSubstr("log.csv"));
  EXPECT_THAT(check.err, HasSubstr(GetParam().message));

  const ProgramAnswer identify =
      RunWarmjoint({"identify", recording, "--identifier", "nominal-ls", "-o",
                    scratch.path() / "e.json", "--mjcf", scratch.path() / "f.xml"});
  EXPECT_EQ(identify.status, 2);
  EXPECT_EQ(identify.out, "");
  EXPECT_EQ(identify.err, check.err);
  for (const auto& entry : std::filesystem::directory_iterator(scratch.path())) {
    EXPECT_EQ(entry.path().filename(), "log.csv") << "left behind";
  }
}

const std::string kHeader = "time,position,velocity,torque\n";

INSTANTIATE_TEST_SUITE_P(
    Kinds, BadRecordings,
    testing::Values(
        BadRecording{"EmptyFile", "", "empty"},
        BadRecording{"MissingColumn", "time,position,velocity\n0,0,1\n1,1,1\n2,2,1\n", "torque"},
        BadRecording{"TextInANumber", kHeader + "0,0,1,2\n1,1,1,2x\n2,2,1,3\n", ":3: "},
        BadRecording{"NaN", kHeader + "0,0,1,2\n1,1,1,nan\n2,2,1,3\n",
                     "1 of 3 rows lack a number (torque)"},
        BadRecording{"TimeBackwards", kHeader + "0,0,1,2\n2,1,1,2\n1,2,1,3\n", ":4: "},
        BadRecording{"DuplicateTimes", kHeader + "0,0,1,2\n1,1,1,2\n1,2,1,3\n", ":4: "},
        BadRecording{"TwoSamples", kHeader + "0,0,1,2\n1,1,1,3\n", "at least 3"},
        BadRecording{"NoHeader", "0 s,0,1,2\n1 s,1,1,2\n2 s,2,1,3\n",
                     "it begins with '0 s,0,1,2'. Name its 4 columns, for example --columns"},
        BadRecording{"ConstantTorque", kHeader + "0,0,1,2\n1,1,1,2\n2,2,1,2\n", "torque"}),
    [](const auto& suite) { return suite.param.name; });

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
        LongInput{"option",
                  kHeader,
                  {"identify", "FILE", "--identifier", "energy-ml", "--set", "law=" + kLong}},
        LongInput{"option_name", kHeader, {"identify", "FILE", "--set", kLong + "=1"}},
        LongInput{"identifier", kHeader, {"identify", "FILE", "--identifier", kLong}},
        LongInput{"argument", "", {"identify", "FILE", "--" + kLong}},
        LongInput{"subcommand", "", {kLong}},
        LongInput{"shard", "", {"run", "FILE", "-o", "OUT", "--shard", kLong}},
        LongInput{"no_json", kLong, {"attach", "pendulum", "-o", "OUT", "--joint", "hinge=FILE"}}),
    [](const auto& suite) { return suite.param.name; });

}  // namespace
}  // namespace warmjoint
