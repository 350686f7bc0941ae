#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/recording.h>

#include <cmath>

#include "models/foundation/atomic_file.h"
#include "tests/tools/cli/recording_file.h"
#include "tests/tools/cli/run_program.h"
#include "tests/tools/interface/motions.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint::api {
namespace {

using testing::HasSubstr;

/// What refuses it says; empty where nothing does.
template <typename Work>
std::string Refusal(const Work& work) {
  try {
    work();
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

using Columns = std::map<std::string, std::vector<double>>;

const Columns kColumns{{"t_ms", {0, 1000, 2000, 3000}},
                       {"position", {0, 90, 180, 270}},
                       {"velocity", {90, 90, 90, 90}},
                       {"torque", {1, 2, 1, 2}}};

TEST(Recording, OfVectorsIsWhatAFileOfThemIs) {
  const ScratchDirectory scratch;
  const std::string file = scratch.path() / "log.csv";
  WriteWholeFile(file,
                 "t_ms,position,velocity,torque\n0,0,90,1\n1000,90,90,2\n2000,180,90,1\n"
                 "3000,270,90,2\n");
  ReadSettings settings;
  settings.map["time"] = "t_ms";
  settings.unit = {{"time", "ms"}, {"position", "deg"}, {"velocity", "deg/s"}};
  settings.scale["torque"] = -1;
  const Recording made = MakeRecording(kColumns, settings), read = ReadRecording(file, settings);
  EXPECT_EQ(made.time, (std::vector<double>{0, 1, 2, 3}));
  EXPECT_EQ(made.torque, (std::vector<double>{-1, -2, -1, -2}));
  EXPECT_DOUBLE_EQ(made.position[1], std::acos(-1.0) / 2);
  EXPECT_EQ(made.time, read.time);
  EXPECT_EQ(made.position, read.position);
  EXPECT_EQ(made.velocity, read.velocity);
  EXPECT_EQ(made.torque, read.torque);
  EXPECT_FALSE(made.origin) << "it came from no file";
  ASSERT_TRUE(read.origin);
  EXPECT_EQ(read.origin->files, std::vector<std::string>{file});
}

TEST(Recording, IsRefusedWithPlaceValueAndRemedy) {
  ReadSettings settings;
  settings.map["time"] = "t_ms";
  const auto refusal = [&](const char* column, std::vector<double> values) {
    Columns columns = kColumns;
    columns[column] = std::move(values);
    return Refusal([&] { MakeRecording(columns, settings, "bench"); });
  };
  EXPECT_THAT(refusal("torque", {1, 2, 3}), HasSubstr("bench: torque has 3 values"));
  EXPECT_THAT(refusal("torque", {1, NAN, 3, 4}), HasSubstr("torque of sample 2 is nan"));
  EXPECT_THAT(refusal("torque", {1, 1, 1, 1}), HasSubstr("is it the right column"));
  EXPECT_THAT(refusal("t_ms", {0, 2, 1, 3}), HasSubstr("runs backwards"));
  EXPECT_THAT(Refusal([] { MakeRecording(kColumns); }), HasSubstr("--map time="));
  settings.gear = 0;
  EXPECT_THAT(refusal("torque", {1, 2, 1, 2}), HasSubstr("other than 0"));
  EXPECT_THAT(Refusal([] { ReadRecording("absent.csv"); }), HasSubstr("absent.csv"));
  EXPECT_NE(Refusal([] { ReadRecordings({}); }), "");
}

TEST(Recording, ThatWasChangedIsCheckedAgain) {
  ReadSettings settings;
  settings.map["time"] = "t_ms";
  const Recording good = MakeRecording(kColumns, settings);
  const auto refusal = [&](auto change) {
    Recording bad = good;
    change(bad);
    return Refusal([&] { PreparedLog{bad}; });
  };
  EXPECT_THAT(refusal([](Recording& r) { r.position.pop_back(); }), HasSubstr("position has 3"));
  EXPECT_THAT(refusal([](Recording& r) { r.load = {1}; }), HasSubstr("load has 1"));
  EXPECT_THAT(refusal([](Recording& r) { r.velocity[2] = INFINITY; }),
              HasSubstr("sample 3 is inf"));
  EXPECT_THAT(refusal([](Recording& r) { r.time[1] = -1; }), HasSubstr("backwards"));
  EXPECT_THAT(refusal([](Recording& r) { r.starts = {2, 2}; }), HasSubstr("ascend"));
  EXPECT_THAT(refusal([](Recording& r) { r.gear = NAN; }), HasSubstr("finite"));
  EXPECT_THAT(Refusal([&] { PreparedLog(good, {-1, 0}); }), HasSubstr("--trim: is -1"));
}

TEST(Recording, ReadsBackBitForBit) {
  const ScratchDirectory scratch;
  const std::string log = scratch.path() / "log.csv", copy = scratch.path() / "copy.h5";
  WriteRecordingFile(log, 120, SeveralSpeeds);
  const Recording recording = ReadRecording(log);
  WriteRecording(recording, copy);
  EXPECT_EQ(ReadRecording(copy).torque, recording.torque);
  EXPECT_EQ(ReadRecording(copy).position, recording.position);
  EXPECT_THROW(WriteRecording(recording, scratch.path() / "copy.txt"), BadInput);
}

TEST(PreparedLog, HasTheSegmentsOfTheCommand) {
  const ScratchDirectory scratch;
  const std::string log = scratch.path() / "log.csv", csv = scratch.path() / "segments.csv";
  WriteRecordingFile(log, 480, SeveralSpeeds);
  ASSERT_EQ(RunWarmjoint({"check", log, "--trim", "2", "--segments", csv}).status, 0);
  std::istringstream lines(ReadWholeFile(csv));
  std::string line;
  std::getline(lines, line);
  const std::vector<Segment> segments = PreparedLog(ReadRecording(log), {2, 0}).segments();
  ASSERT_GT(segments.size(), 4u);
  for (const Segment& segment : segments) {
    ASSERT_TRUE(std::getline(lines, line));
    std::istringstream cells(line);
    double number = 0, begin = 0, end = 0, velocity = 0, samples = 0;
    char comma = 0;
    cells >> number >> comma >> begin >> comma >> end >> comma >> velocity >> comma >> samples;
    EXPECT_EQ(segment.recording, number);
    EXPECT_EQ(segment.begin, begin);
    EXPECT_EQ(segment.end, end);
    EXPECT_EQ(segment.velocity, velocity);
    EXPECT_EQ(static_cast<double>(segment.samples), samples);
  }
  EXPECT_FALSE(std::getline(lines, line)) << "all of them";
}

TEST(Check, SaysWhatTheCommandSays) {
  const ScratchDirectory scratch;
  const std::string log = scratch.path() / "log.csv";
  WriteRecordingFile(log, 480, SeveralSpeeds);
  const RecordingCheck check = Check(ReadRecording(log));
  EXPECT_EQ(check.text, RunWarmjoint({"check", log}).out);
  EXPECT_EQ(check.json, RunWarmjoint({"check", log, "--format", "json"}).out);
  EXPECT_EQ(check.sampling.samples, 480u);
  EXPECT_EQ(check.sampling.step, 1);
  EXPECT_EQ(check.motion.levels.size(), 8u);
  EXPECT_TRUE(check.faults.empty());
  EXPECT_FALSE(check.excitation.empty());
}

TEST(Version, IsThatOfTheProgramAndOfTheHeaders) {
  EXPECT_EQ(RunWarmjoint({"--version"}).out, "warmjoint " + Version() + "\n");
  EXPECT_EQ(Version(), std::to_string(WARMJOINT_VERSION_MAJOR) + "." +
                           std::to_string(WARMJOINT_VERSION_MINOR) + "." +
                           std::to_string(WARMJOINT_VERSION_PATCH));
}

}  // namespace
}  // namespace warmjoint::api
