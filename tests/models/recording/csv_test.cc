#include "models/recording/csv.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "tests/models/recording/temporary_file.h"

namespace warmjoint {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const char* const kPlain =
    "time,position,velocity,torque\n"
    "0,0,0.5,1\n"
    "0.1,0.05,0.5,1.25\n"
    "0.2,0.1,0.5,-1e-3\n";

Measurements Read(const std::string& text, const ReadSettings& layout = {}) {
  const TemporaryFile file("log.csv", text);
  return ReadCsv(file.path(), layout);
}

/// The message with which `text` is refused; empty where it is not.
std::string Refusal(const std::string& text, const ReadSettings& layout = {}) {
  const TemporaryFile file("log.csv", text.empty() ? "\n" : text);
  try {
    ReadCsv(file.path(), layout);
  } catch (const BadInput& refusal) {
    return refusal.what();
  }
  return "";
}

TEST(ReadCsv, ReadsColumnsInAnyOrder) {
  const Measurements log = Read(
      "torque,note,time,velocity,position\n"
      "1,cold,0,0.5,0\n1.25,\"warm, or so\",0.1,0.5,0.05\n-1e-3,,0.2,+0.5,0.1\n");
  ASSERT_EQ(log.size(), 3);
  EXPECT_EQ(log.time, Eigen::Vector3d(0, 0.1, 0.2));
  EXPECT_EQ(log.position, Eigen::Vector3d(0, 0.05, 0.1));
  EXPECT_EQ(log.velocity, Eigen::Vector3d(0.5, 0.5, 0.5));
  EXPECT_EQ(log.torque, Eigen::Vector3d(1, 1.25, -1e-3));
  EXPECT_EQ(log.torque_unit, "N.m");
  EXPECT_FALSE(log.load || log.motor_position || log.temperature);
}

TEST(ReadCsv, UnderstandsTheWaysOfOtherPrograms) {
  const Eigen::Vector3d torque(1, 1.25, -1e-3);
  const std::string rows = "0,0,0.5,1\r\n0.1,0.05,0.5,1.25\r\n0.2,0.1,0.5,-1e-3\r\n";
  EXPECT_EQ(Read("time,position,velocity,torque\r\n" + rows).torque, torque) << "Windows";
  EXPECT_EQ(Read("\xEF\xBB\xBFtime,position,velocity,torque\r\n" + rows).torque, torque) << "BOM";
  EXPECT_EQ(Read("\"time\",\"position\", \"velocity\" ,\"torque\"\n" + rows).torque, torque);
  EXPECT_EQ(Read("# a log\n\n time , position,velocity,torque\n" + rows + "\n\n").torque, torque);

  // other separators, with and without a newline at the end
  for (const char separator : {';', '\t'}) {
    std::string text = kPlain;
    for (char& c : text) c = c == ',' ? separator : c;
    EXPECT_EQ(Read(text).torque, torque) << separator;
    text.pop_back();
    EXPECT_EQ(Read(text).torque, torque) << separator;
  }
}

TEST(ReadCsv, ConvertsToSi) {
  ReadSettings layout;
  layout.map = {{"time", "ms"}, {"position", "angle"}, {"velocity", "speed"}, {"torque", "i"}};
  layout.unit = {{"time", "ms"}, {"position", "deg"}, {"velocity", "rpm"}, {"torque", "mA"}};
  layout.gear = 45;
  const Measurements log =
      Read("ms,angle,speed,i\n0,180,60,100\n5,90,-60,200\n10,0,0,300\n", layout);
  const double pi = std::numbers::pi;
  EXPECT_DOUBLE_EQ(log.time[1], 0.005);
  EXPECT_DOUBLE_EQ(log.position[0], pi);
  EXPECT_DOUBLE_EQ(log.velocity[1], -2 * pi);
  EXPECT_DOUBLE_EQ(log.torque[2], 0.3);
  EXPECT_EQ(log.torque_unit, "A") << "a current stays a current";
  EXPECT_EQ(log.gear, 45);
}

TEST(ReadCsv, KnowsLinearJoints) {
  ReadSettings layout;
  layout.joint = JointKind::linear;
  layout.unit = {{"position", "mm"}};
  const Measurements log = Read(kPlain, layout);
  EXPECT_DOUBLE_EQ(log.position[2], 1e-4);
  EXPECT_EQ(log.torque_unit, "N");
  EXPECT_EQ(log.joint, JointKind::linear);

  layout.unit = {{"position", "deg"}};
  EXPECT_THAT(Refusal(kPlain, layout),
              AllOf(HasSubstr("position cannot be in 'deg'"), HasSubstr("mm")));
}

TEST(ReadCsv, LeavesAMissingVelocityEmpty) {
  EXPECT_EQ(Read("time,position,torque\n0,0,1\n1,1,2\n2,2,1\n").velocity.size(), 0);
}

TEST(ReadCsv, UnwrapsARotaryPosition) {
  std::string text = "time,position,torque\n";
  for (int i = 0; i < 100; ++i) text += fmt::format("{},{},{}\n", i, (7 * i) % 360, i % 3);
  ReadSettings layout;
  layout.unit = {{"position", "deg"}};
  const Measurements log = Read(text, layout);
  EXPECT_NEAR(log.position[99], 693 * std::numbers::pi / 180, 1e-12);
  ASSERT_EQ(log.notes.size(), 1U);
  EXPECT_EQ(log.notes[0], "position jumps by a turn 1 times; unwrapped");
}

TEST(ReadCsv, MultipliesColumnsByFactors) {
  ReadSettings layout;
  layout.scale = {{"torque", -2}};
  layout.unit = {{"position", "deg"}};
  const std::string text = "time,position,torque\n0,180,1\n1,181,2\n2,182,1\n";
  const Measurements log = Read(text, layout);
  EXPECT_EQ(log.torque, Eigen::Vector3d(-2, -4, -2));
  EXPECT_NEAR(log.position[0], std::numbers::pi, 1e-12);
  layout.scale = {{"torque", 0}};
  EXPECT_THAT(Refusal(text, layout), HasSubstr("other than 0"));
  layout.scale = {{"torq", 2}};
  EXPECT_THAT(Refusal(text, layout), HasSubstr("did you mean 'torque'"));
}

TEST(ReadCsv, UnwrapsAPositionByItsRange) {
  std::string text = "time,position,torque\n";
  for (int i = 0; i < 100; ++i) text += fmt::format("{},{},{}\n", i, (700 * i) % 2500, i % 3);
  ReadSettings layout;
  layout.unit = {{"position", "mm"}};
  layout.joint = JointKind::linear;
  layout.wrap = 2500;
  const Measurements log = Read(text, layout);
  EXPECT_NEAR(log.position[99], 69.3, 1e-9);
}

TEST(ReadCsv, RefusesWhatIsNoRecording) {
  EXPECT_THAT(Refusal(""), HasSubstr("is empty"));
  EXPECT_THAT(Refusal("\n \r\n"), HasSubstr("is empty"));
  EXPECT_THAT(Refusal("0,1,2,3\n1,2,3,4\n"),
              HasSubstr("log.csv:1: holds numbers where the header"));
  EXPECT_THAT(Refusal("time,position,velocity,torque\n"), HasSubstr("has 0 samples; at least 3"));
  EXPECT_THAT(Refusal("time,position,velocity,torque\n0,0,1,1\n1,1,1,2\n"),
              HasSubstr("has 2 samples; at least 3"));
  EXPECT_THROW(ReadCsv("there/is/none.csv"), BadInput);
}

TEST(ReadCsv, NamesTheMapThatAMissingColumnNeeds) {
  const std::string text = "t_s,q_m,q_ref_m,force_N\n0,0,0,1\n1,1,1,2\n2,2,2,3\n";
  EXPECT_THAT(Refusal(text),
              AllOf(HasSubstr("log.csv:1: has no column 'time'"), HasSubstr("t_s, q_m, q_ref_m"),
                    HasSubstr("--map time=t_s,position=q_m,torque=force_N")));

  ReadSettings layout;
  layout.map = {{"time", "t_s"}, {"position", "q_n"}, {"torque", "force_N"}};
  EXPECT_THAT(Refusal(text, layout),
              AllOf(HasSubstr("no column 'q_n' (for position)"), HasSubstr("did you mean 'q_m'?")));
  layout.map = {{"times", "t_s"}};
  EXPECT_THAT(Refusal(text, layout), AllOf(HasSubstr("--map times=t_s"), HasSubstr("'time'?")));
  EXPECT_THAT(Refusal("time,position,torque,torque\n0,0,1,1\n"), HasSubstr("'torque' twice"));
}

TEST(ReadCsv, RefusesUnknownUnits) {
  ReadSettings layout;
  layout.unit = {{"position", "degg"}};
  EXPECT_THAT(Refusal(kPlain, layout), HasSubstr("did you mean 'deg'?"));
  layout.unit = {{"positon", "deg"}};
  EXPECT_THAT(Refusal(kPlain, layout), HasSubstr("did you mean 'position'?"));
  layout.unit = {{"temperature", "K"}};
  EXPECT_THAT(Refusal(kPlain, layout), HasSubstr("the file has no temperature"));
}

TEST(ReadCsv, RefusesBadRowsByLine) {
  const std::string header = "time,position,velocity,torque\n";
  EXPECT_THAT(Refusal(header + "0,0,1,1\n1,1,1,two\n2,2,1,3\n"),
              HasSubstr("log.csv:3: torque is 'two', which is not a number"));
  EXPECT_THAT(Refusal(header + "0,0,1,1\n1,1,1,\n2,2,1,3\n"), HasSubstr(":3: torque is empty"));
  EXPECT_THAT(Refusal(header + "0,0,1,1\n1,1,1,2\n2,2,1\n"),
              HasSubstr(":4: has 3 fields where the header has 4"));
  EXPECT_THAT(Refusal(header + "0,0,1,1\n1,1,1,2,5\n2,2,1,3\n"), HasSubstr(":3: has 5 fields"));
  EXPECT_THAT(Refusal("time;position;torque\n0;0;0,5\n1;1;0,6\n2;2;0,7\n"),
              HasSubstr("write decimals with a point"));
  EXPECT_THAT(Refusal(header + "0,0,1,1\n1,1,nan,2\n2,2,1,3\n"),
              HasSubstr(":3: velocity of sample 2 is nan; it must be a finite"));
  EXPECT_THAT(Refusal(header + "0,0,1,1\n1,1,1,2\n2,-inf,1,3\n"),
              HasSubstr(":4: position of sample 3 is -inf"));
  EXPECT_THAT(Refusal(header + "0,0,1,1\n1,1,1,1e999\n2,2,1,3\n"),
              HasSubstr(":3: torque is '1e999'"));
}

TEST(Csv, RefusesMoreColumnsThanAnyLogHas) {
  const std::string wide = "time,position,velocity,torque" + std::string(5'000'000, ',') + "\n";
  EXPECT_THAT(Refusal(wide), HasSubstr(":1: has 5000004 columns; 10000 at most"));
  EXPECT_THAT(Refusal("time,position,velocity,torque\n0" + std::string(5'000'000, ',') + "\n"),
              HasSubstr(":2: has 5000001 fields where the header has 4"));
}

TEST(ReadCsv, RefusesTimeThatDoesNotIncrease) {
  const std::string start = "time,position,velocity,torque\n0,0,1,1\n\n1,1,1,2\n";
  EXPECT_THAT(Refusal(start + "1,1,1,3\n"),
              HasSubstr("log.csv:5: time 1 s of sample 3 is that of the sample before"));
  EXPECT_THAT(Refusal(start + "0.5,1,1,3\n"),
              AllOf(HasSubstr(":5: time of sample 3 is 0.5 s, after 1 s"), HasSubstr("sort")));
}

TEST(ReadCsv, RefusesTimesThatAreNoTimes) {
  EXPECT_THAT(Refusal("time,position,torque\n0,0,1\n1e-300,1,2\n2e-300,2,3\n"),
              AllOf(HasSubstr("samples are 1e-300 s apart"), HasSubstr("--unit time=ms")));
}

TEST(ReadCsv, RefusesAConstantTorque) {
  EXPECT_THAT(Refusal("time,position,velocity,torque\n0,0,1,7\n1,1,1,7\n2,2,1,7\n"),
              HasSubstr("torque is 7 N.m in all 3 samples"));
}

TEST(RecordingToCsv, ReadsBackBitForBit) {
  Measurements log = Read(kPlain);
  log.velocity = Eigen::Vector3d(1.0 / 3, std::nextafter(1, 2), -4e-320);
  log.temperature = Eigen::Vector3d(20, 20.1, 1e30);
  const TemporaryFile file("copy.csv");
  WriteWholeFile(file.path(), RecordingToCsv(log));
  const Measurements copy = ReadCsv(file.path());
  EXPECT_EQ(copy.time, log.time);
  EXPECT_EQ(copy.velocity, log.velocity);
  EXPECT_EQ(copy.torque, log.torque);
  EXPECT_EQ(copy.temperature, log.temperature);
}

TEST(ReadCsv, ReadsTwentyMinutes) {
  std::string text = "time,position,velocity,torque\n";
  for (int i = 0; i < 25000; ++i) {
    text += fmt::format("{},{},{},{}\n", 0.05 * i, std::sin(i), std::cos(i), std::sin(2 * i));
  }
  const TemporaryFile file("long.csv", text);
  const Measurements log = ReadCsv(file.path());
  ASSERT_EQ(log.size(), 25000);
  EXPECT_EQ(log.torque[24999], std::sin(2 * 24999));
}

}  // namespace
}  // namespace warmjoint
