// Wrong usages, unusable recordings and long inputs: refused in few words that name the right thing, with nothing left behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "models/foundation/atomic_file.h"
#include "tests/support/folders.h"
#include "tests/tools/cli/in_a_folder.h"
#include "tests/tools/cli/little_files.h"

namespace warmjoint {
namespace {

using ::testing::AllOf;
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
      {{"check", "log.csv", "--identifier", "auto"}, "requires --until"},
      {{"check", "log.csv", "--identifer", "auto"}, "'--identifier'"},
      {{"check", "suite.yaml"}, "time"},
      // identify
      {{"identify", "log.csv", "--identifier", "energyml"}, "'energy-ml'"},
      {{"identify", "log.csv", "--identifier", "energy-ml", "--set", "lw=coulomb"}, "'law'"},
      {{"identify", "log.csv", "--set", "law=coulomb"}, "energy-ml"},
      {{"identify", "log.csv", "--set", "lawn=coulomb"}, "'law'? Name one that has it"},
      {{"identify", "log.csv", "--set", "block=6"}, "'blocks'"},
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
      {{"simulate", "scenario.yaml", "-o", "d", "--set", "noise.torque=-1"}, "-1"},
      {{"simulate", "scenario.yaml", "-o", "d", "--set", "noise"}, "not of the form key=value"},
      {{"simulate", "scenario.yaml", "-o", "d", "--set", "friction.parameters.viscous=fast"},
       "fast"},
      {{"simulate", "scenario.yaml", "-o", "d", "--set", "plant=mujocco"}, "mujoco"},
      {{"simulate", "scenario.yaml", "-o", "d", "--set", "plant=mujoco", "--set", "robot=pendulum",
        "--set", "joint=elbow"},
       "elbow"},
      {{"simulate", "unknown.yaml", "-o", "d"}, "unknown.yaml:10: "},
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
      {{"plot", "kernels", "--size", "5x5", "-o", "d"}, "'5x5' is no size"},
      {{"plot", "kernels", "--figure", "9", "-o", "d"},
       "figure 9 of the paper (motor_fit) needs an estimate with a map over the motor's angle; "
       "this "
       "source gives: kernels"},
      // robots
      {{"attach", "pendulm", "--joint", "hinge=f.json", "-o", "d.xml"}, "'pendulum'"},
      {{"attach", "pendulum", "--joint", "hinge", "-o", "d.xml"}, "NAME=FILE"},
      {{"attach", "pendulum", "--joint", "hinge=log.csv", "-o", "d.xml"},
       "warmjoint identify log.csv -o estimate.json"},
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

using Refusals = InAFolder;

TEST_F(Refusals, OfWrongUsagesAreBriefWithTheNearestRightThing) {
  WriteRecordingFile(at("log.csv"), 200,
                     [](int i) { return (i / 20 % 2 ? -1 : 1) * (i / 40 % 2 ? 0.5 : 1.0); });
  WriteWholeFile(at("scenario.yaml"), TableOneYaml(60));
  WriteWholeFile(at("unknown.yaml"), TableOneYaml(60) + "speeed: 3\n");
  WriteWholeFile(at("suite.yaml"), TableOneSuite(1, "  - {name: nominal-ls}\n"));
  const std::set<std::string> before = Holdings(scratch_.path());

  for (const auto& [arguments, right] : WrongUsages()) {
    SCOPED_TRACE(testing::PrintToString(arguments));
    const ProgramAnswer answer = Program(arguments);
    EXPECT_EQ(answer.status, 2);
    EXPECT_EQ(answer.out, "");
    EXPECT_THAT(answer.err, HasSubstr(right));
    EXPECT_LE(answer.err.size(), 300u) << answer.err;
    EXPECT_EQ(Holdings(scratch_.path()), before);
  }
}

const std::string kHeader = "time,position,velocity,torque\n";

struct BadRecording {
  std::string name;
  std::string text;
  std::string message;  // part of what must be said
};

const std::vector<BadRecording> kBadRecordings{
    {"empty file", "", "empty"},
    {"missing column", "time,position,velocity\n0,0,1\n1,1,1\n2,2,1\n", "torque"},
    {"text in a number", kHeader + "0,0,1,2\n1,1,1,2x\n2,2,1,3\n", ":3: "},
    {"NaN", kHeader + "0,0,1,2\n1,1,1,nan\n2,2,1,3\n", "1 of 3 rows lack a number (torque)"},
    {"time backwards", kHeader + "0,0,1,2\n2,1,1,2\n1,2,1,3\n", ":4: "},
    {"duplicate times", kHeader + "0,0,1,2\n1,1,1,2\n1,2,1,3\n", ":4: "},
    {"two samples", kHeader + "0,0,1,2\n1,1,1,3\n", "at least 3"},
    {"no header", "0 s,0,1,2\n1 s,1,1,2\n2 s,2,1,3\n",
     "it begins with '0 s,0,1,2'. Name its 4 columns, for example --columns"},
    {"constant torque", kHeader + "0,0,1,2\n1,1,1,2\n2,2,1,2\n", "torque"}};

TEST_F(Refusals, OfBadRecordingsNameTheFaultAndLeaveNothingBehind) {
  for (const auto& [name, text, message] : kBadRecordings) {
    SCOPED_TRACE(name);
    WriteWholeFile(at("log.csv"), text);
    const std::string check = Refusal({"check", "log.csv"});
    EXPECT_THAT(check, AllOf(HasSubstr("log.csv"), HasSubstr(message)));

    const ProgramAnswer identify = Program(
        {"identify", "log.csv", "--identifier", "nominal-ls", "-o", "e.json", "--mjcf", "f.xml"});
    EXPECT_EQ(identify.status, 2);
    EXPECT_EQ(identify.out, "");
    EXPECT_EQ(identify.err, check);
    EXPECT_EQ(Holdings(scratch_.path()).size(), 1u) << "left behind";
  }
}

/// Text of any length and content that a file or an option may hold.
const std::string kLong = std::string(20000, 'x') + "\x1b[31m";

struct LongInput {
  std::string name;
  std::string file;  // the content of given.txt
  std::vector<std::string> arguments;
};

const std::string kYaml = "plant: ideal\nduration: ";

std::string ManyColumns() {
  std::string header;
  for (int i = 0; i < 5000; ++i) header += "column" + std::to_string(i) + ",";
  return header + "c\n";
}

const std::vector<LongInput> kLongInputs{
    {"cell", kHeader + "0,0,1," + kLong + "\n", {"check", "given.txt"}},
    {"column", kLong + ",1\n0,0\n", {"check", "given.txt"}},
    {"columns", ManyColumns(), {"check", "given.txt"}},
    {"mapped", kHeader, {"check", "given.txt", "--map", "torque=" + kLong}},
    {"unit", kHeader, {"check", "given.txt", "--unit", "torque=" + kLong}},
    {"pair", kHeader, {"check", "given.txt", "--map", kLong}},
    {"value", kYaml + kLong, {"simulate", "given.txt", "-o", "out"}},
    {"key", kLong + ": 3\n", {"simulate", "given.txt", "-o", "out"}},
    {"word", "plant: " + kLong, {"simulate", "given.txt", "-o", "out"}},
    {"setting", kYaml + "3", {"simulate", "given.txt", "-o", "out", "--set", "seed=" + kLong}},
    {"option",
     kHeader,
     {"identify", "given.txt", "--identifier", "energy-ml", "--set", "law=" + kLong}},
    {"option name", kHeader, {"identify", "given.txt", "--set", kLong + "=1"}},
    {"identifier", kHeader, {"identify", "given.txt", "--identifier", kLong}},
    {"argument", "", {"identify", "given.txt", "--" + kLong}},
    {"subcommand", "", {kLong}},
    {"shard", "", {"run", "given.txt", "-o", "out", "--shard", kLong}},
    {"no JSON", kLong, {"attach", "pendulum", "-o", "out", "--joint", "hinge=given.txt"}}};

TEST_F(Refusals, OfLongInputsAreInFewWords) {
  for (const auto& [name, file, arguments] : kLongInputs) {
    SCOPED_TRACE(name);
    WriteWholeFile(at("given.txt"), file);
    const std::string err = Refusal(arguments);
    // the longest that is not the input's own: a list of 24 known names beside an excerpt of 60
    EXPECT_LT(err.size(), 900u) << err;
    EXPECT_EQ(err.find('\x1b'), std::string::npos) << "controls the terminal";
    EXPECT_NE(err, "");
  }
}

}  // namespace
}  // namespace warmjoint
