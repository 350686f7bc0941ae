// What the public headers promise: the library does what the command line does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/attach.h>
#include <warmjoint/errors.h>
#include <warmjoint/identify.h>
#include <warmjoint/score.h>
#include <warmjoint/suite.h>

#include <array>
#include <functional>
#include <sstream>
#include <thread>

#include "models/robots/robot_folder.h"
#include "tests/support/folders.h"
#include "tests/support/refusal.h"
#include "tests/tools/cli/in_a_folder.h"
#include "tests/tools/cli/little_files.h"

namespace warmjoint {
namespace {

using testing::HasSubstr;

/// One speed in both directions, rad/s.
double OneSpeed(int i) { return i / 20 % 2 ? -0.5 : 0.5; }

/// A scenario of the paper's joint, carried out. seconds: of its duration.
Simulation TableOneRun(int seconds) {
  const ScratchDirectory scratch;
  WriteWholeFile(scratch.path() / "scenario.yaml", TableOneYaml(seconds));
  return warmjoint::Simulate(scratch.path() / "scenario.yaml", {.seed = 3});
}

/// One thing asked of both: the arguments behind RECORDING, and the settings that mean the same.
struct Asked {
  std::string name;
  std::vector<std::string> arguments;
  std::function<void(RecordingSource&, IdentifySettings&, HoldOutSource&)> set;
  Status status = Status::ok;
  double (*velocity)(int) = SeveralSpeeds;
};

const std::vector<Asked> kAsked{
    {"Defaults", {}, [](auto&, auto&, auto&) {}},
    {"Refused",
     {"--identifier", "nominal-ls"},
     [](auto&, auto& settings, auto&) { settings.identifier = "nominal-ls"; },
     Status::not_identifiable,
     OneSpeed},
    {"LinearJointInOtherUnits",
     {"--identifier", "nominal-ls", "--unit", "position=mm,velocity=mm/s,torque=kN", "--joint",
      "linear", "--gear", "3", "--scale", "torque=0.5"},
     [](auto& source, auto& settings, auto&) {
       settings.identifier = "nominal-ls";
       source.read.unit = {{"torque", "kN"}, {"position", "mm"}, {"velocity", "mm/s"}};
       source.read.joint = JointKind::linear;
       source.read.gear = 3;
       source.read.scale = {{"torque", 0.5}};
     }},
    {"OptionsGravityAndTrimmedHolds",
     {"--identifier", "nominal-ls", "--set", "law=asymmetric", "--gravity", "sincos", "--trim", "1",
      "--shortest-hold", "2", "--start", "unknown", "--relevance", "0.05", "--holdout", "0.4"},
     [](auto& source, auto& settings, auto& holdout) {
       settings.identifier = "nominal-ls";
       settings.options = {{"law", "asymmetric"}};
       settings.gravity = FittedGravity::sincos;
       settings.start = StartBelief::unknown;
       settings.relevance = 0.05;
       holdout.fraction = 0.4;
       source.prepare = {1, 2};
     }},
    {"ACurrentWhichMuJoCoDoesNotKnow",
     {"--identifier", "nominal-ls", "--unit", "torque=A"},
     [](auto& source, auto& settings, auto&) {
       settings.identifier = "nominal-ls";
       source.read.unit = {{"torque", "A"}};
     }}};

class Library : public InAFolder {};

TEST_F(Library, IdentifiesToTheSameFileAsTheCommandToTheLastByte) {
  const std::string log = at("log.csv"), file = at("estimate.json");
  for (const Asked& asked : kAsked) {
    SCOPED_TRACE(asked.name);
    WriteRecordingFile(log, 480, asked.velocity);
    const ProgramAnswer answer = RunWarmjoint(With({"identify", log, "-o", file}, asked.arguments));
    EXPECT_EQ(answer.status, asked.status == Status::ok ? 0 : 3) << answer.err;

    RecordingSource source{{log}, {}, {}};
    IdentifySettings settings;
    HoldOutSource holdout;
    asked.set(source, settings, holdout);
    Estimate estimate =
        Identify(Prepare(ReadRecordings(source), source.prepare), settings, holdout);
    EXPECT_EQ(estimate.status, asked.status) << estimate.message;
    estimate.recording = source;
    WriteEstimate(estimate, at("ours.json"));
    EXPECT_EQ(File("ours.json"), File("estimate.json"));

    // and there and back as values
    WriteEstimate(ReadEstimate(file), at("back.json"));
    EXPECT_EQ(File("back.json"), File("estimate.json"));
  }
}

TEST_F(Library, FollowsAnEarlierRecordingAsTheCommand) {
  const std::string log = at("log.csv"), earlier = at("earlier.json"), file = at("estimate.json");
  WriteRecording(TableOneRun(3600).measurements, log);
  RunWarmjoint({"identify", log, "-o", earlier});
  RunWarmjoint({"identify", log, "--follows", earlier, "--pause", "60", "-o", file});

  const Measurements recording = ReadRecordings({{log}, {}, {}}).front();
  const CarriedHeat heat = CarryOver(HeatLeftBy(ReadEstimate(earlier), earlier), 60, recording);
  Estimate estimate = Identify(Prepare(recording), {}, {}, heat);
  estimate.recording = RecordingSource{{log}, {}, {}};
  WriteEstimate(estimate, at("ours.json"));
  EXPECT_EQ(File("ours.json"), File("estimate.json"));
  // the truth is -3; its standard error over an hour is some 0.1
  EXPECT_NEAR(estimate.Find("thermal_gain")->value, -3, 0.5);
}

TEST(Identify, RefusesAShareToHoldOutThatIsNone) {
  const PreparedLog log = Prepare(TableOneRun(600).measurements);
  EXPECT_THAT(test::RefusalOf([&] { Identify(log, {}, {1, {}}); }), HasSubstr("below 1"));
}

TEST(Identify, AnswersTheSameInManyThreads) {
  const PreparedLog log = Prepare(TableOneRun(1200).measurements);
  const std::string alone = EstimateToJson(Identify(log));
  std::array<std::string, 4> answers;
  {
    std::vector<std::jthread> threads;
    for (std::string& answer : answers) {
      threads.emplace_back([&] { answer = EstimateToJson(Identify(log)); });
    }
  }
  for (const std::string& answer : answers) EXPECT_EQ(answer, alone);
}

TEST_F(Library, ReadsVectorsAsAFileOfThem) {
  WriteWholeFile(at("log.csv"),
                 "t_ms,position,velocity,torque\n0,0,90,1\n1000,90,90,2\n2000,180,90,1\n"
                 "3000,270,90,2\n");
  std::map<std::string, std::vector<double>> columns{{"t_ms", {0, 1000, 2000, 3000}},
                                                     {"position", {0, 90, 180, 270}},
                                                     {"velocity", {90, 90, 90, 90}},
                                                     {"torque", {1, 2, 1, 2}}};
  ReadSettings settings;
  settings.map = {{"time", "t_ms"}};
  settings.unit = {{"time", "ms"}, {"position", "deg"}, {"velocity", "deg/s"}};
  settings.scale = {{"torque", -1}};
  const Measurements made = MakeRecording(columns, settings, "bench");
  const Measurements read = ReadRecordings({{at("log.csv")}, settings, {}}).front();
  EXPECT_EQ(made.torque, Eigen::Vector4d(-1, -2, -1, -2));
  EXPECT_EQ(made.time, read.time);
  EXPECT_EQ(made.position, read.position);
  EXPECT_EQ(made.velocity, read.velocity);
  EXPECT_EQ(made.torque, read.torque);

  columns["torque"].pop_back();
  EXPECT_THAT(test::RefusalOf([&] { MakeRecording(columns, settings, "bench"); }),
              HasSubstr("bench: "));
  EXPECT_THAT(test::RefusalOf([&] {
                ReadRecordings({{"absent.csv"}, {}, {}});
              }),
              HasSubstr("absent.csv"));
}

TEST_F(Library, WritesTheModelOfTheCommandInBothForms) {
  const auto theirs = at("theirs.xml"), ours = at("ours.xml");
  const std::string friction = DataFolder() / "models/robots/yumi_like/friction.json";
  for (const FrictionForm form : {FrictionForm::actuator, FrictionForm::passive}) {
    const ProgramAnswer answer = RunWarmjoint(
        {"attach", "yumi_like", "--joint", "joint_.*=" + friction, "--as",
         std::string(NameOf(form)), "--initial", "settled:0.2", "--armature", "joint_.*=0.125",
         "--integrator", "implicitfast", "--timestep", "0.0005", "-o", theirs});
    ASSERT_EQ(answer.status, 0) << answer.err;
    std::vector<std::string> warnings;
    AttachOptions options;
    options.form = form;
    options.armatures = {{"joint_.*", 0.125}};
    options.integrator = mjINT_IMPLICITFAST;
    options.timestep = 0.0005;
    const Attached attached = AttachFriction(
        FindRobot("yumi_like", "model"),
        {ReadFrictionForJoint("joint_.*", friction, "settled:0.2", warnings)}, ours, options);
    EXPECT_EQ(File("ours.xml"), File("theirs.xml"));
    EXPECT_EQ(attached.joints.size(), 7u);
  }
}

TEST_F(Library, HasTheLeaderboardOfTheCommandAndItsScores) {
  const std::string suite = at("little.yaml");
  const auto theirs = at("theirs"), ours = at("ours");
  WriteWholeFile(suite, TableOneSuite(6, "  - {name: nominal-ls}\n  - {name: energy-ml}\n"));
  ASSERT_EQ(RunWarmjoint({"run", suite, "-o", theirs, "--realizations", "3"}).status, 0);
  for (const std::string format : {"text", "markdown", "json", "csv"}) {
    EXPECT_EQ(FormatLeaderboard(theirs, format),
              RunWarmjoint({"compare", theirs, "--format", format}).out);
  }

  // stopped by whom it tells, then to its end in quiet
  RunArguments arguments;
  arguments.suite = suite;
  arguments.output = ours;
  arguments.realizations = 3;
  arguments.jobs = 1;
  EXPECT_THROW(warmjoint::Run(arguments, [](int, int) { throw std::runtime_error("enough"); }),
               std::runtime_error);
  testing::internal::CaptureStderr();
  const RunEnding ending = warmjoint::Run(arguments);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(ending.realizations, 3);
  EXPECT_EQ(ending.results, 6u);

  const Leaderboard board = ReadLeaderboard(ours), other = ReadLeaderboard(theirs);
  ASSERT_EQ(board.rows.size(), other.rows.size());
  for (std::size_t i = 0; i < board.rows.size(); ++i) {
    EXPECT_EQ(board.rows[i].identifier, other.rows[i].identifier);
    // the program masks glibc's forms with fused multiply-adds, this process does not: an iterative
    // fit then differs by what it leaves open
    EXPECT_NEAR(board.rows[i].npe_continuous.median, other.rows[i].npe_continuous.median, 1e-6);
  }
  EXPECT_THAT(test::RefusalOf([&] { FormatLeaderboard(ours, "xls"); }), HasSubstr("xls"));
  arguments.jobs = 0;
  EXPECT_THAT(test::RefusalOf([&] { warmjoint::Run(arguments); }), HasSubstr("from 1 to 1024"));
}

/// Settings that name energy-ml alone.
IdentifySettings EnergyMl() {
  IdentifySettings settings;
  settings.identifier = "energy-ml";
  return settings;
}

TEST_F(Library, HasTheScoreOfTheLeaderboard) {
  RunArguments arguments;
  arguments.suite = at("little.yaml");
  arguments.output = at("run");
  WriteWholeFile(arguments.suite, TableOneSuite(1, "  - {name: energy-ml}\n"));
  warmjoint::Run(arguments);
  const LeaderboardRow row = ReadLeaderboard(arguments.output).rows.front();

  const Simulation simulation = TableOneRun(1800);
  const PreparedLog log = Prepare(simulation.measurements);
  const Score score = ScoreEstimate(Identify(log, EnergyMl()), log, simulation.truth);
  EXPECT_DOUBLE_EQ(score.npe_continuous, row.npe_continuous.median);
  EXPECT_DOUBLE_EQ(score.npe_discrete, row.npe_discrete.median);

  Truth other = simulation.truth;
  other.force.conservativeResize(5);
  EXPECT_NE(test::RefusalOf([&] { ScoreEstimate({}, log, other); }), "accepted");
  EXPECT_NE(test::RefusalOf(
                [] { NormalisedParameterError(Eigen::Vector2d(1, 2), Eigen::Vector2d(1, 0)); }),
            "accepted");
}

TEST(Readme, ShowsTheProgramThatIsTested) {
  // each line of the program, indented
  std::istringstream program(ReadWholeFile(test::SourceFolder() / "tests/consumer/main.cc"));
  std::string shown;
  for (std::string line; std::getline(program, line);)
    shown += line.empty() ? "\n" : "    " + line + "\n";
  EXPECT_THAT(ReadWholeFile(test::SourceFolder() / "tools/include/README.md"), HasSubstr(shown));
}

TEST(Version, IsThatOfTheProgramAndOfTheHeaders) {
  EXPECT_EQ(RunWarmjoint({"--version"}).out, "warmjoint " + Version() + "\n");
}

}  // namespace
}  // namespace warmjoint
