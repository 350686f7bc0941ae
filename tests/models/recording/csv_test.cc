#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <numbers>
#include <utility>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/robust_noise.h"
#include "models/recording/read_recording.h"
#include "models/recording/units.h"
#include "tests/models/recording/temporary_file.h"
#include "tests/support/refusal.h"

namespace warmjoint {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

const char* const kPlain =
    "time,position,velocity,torque\n"
    "0,0,0.5,1\n"
    "0.1,0.05,0.5,1.25\n"
    "0.2,0.1,0.5,-1e-3\n";

Measurements Read(const std::string& text, const ReadSettings& layout = {}) {
  const TemporaryFile file("log.csv", text);
  return ReadCsv(file.path(), layout);
}

/// The message with which `text` is refused.
std::string Refusal(const std::string& text, const ReadSettings& layout = {}) {
  const TemporaryFile file("log.csv", text.empty() ? "\n" : text);
  return test::RefusalOf([&] { ReadCsv(file.path(), layout); });
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

TEST(ReadCsv, JoinsNamesOfTwoRows) {
  // as a frame with two rows of columns is written, and as merged cells are
  const char* const written = ",knee,knee,ankle,ankle\n,angle,torque,angle,torque\ntime,,,,\n";
  const char* const merged = ",knee,,ankle,\ntime,angle,torque,angle,torque\n";
  for (const char* head : {written, merged}) {
    const TemporaryFile file("log.csv", std::string(head) + "0,1,2,3,4\n1,2,3,4,5\n2,4,7,6,1\n");
    ReadSettings settings;
    settings.map["position"] = "ankle/angle";
    settings.map["torque"] = "ankle/torque";
    const Measurements log = ReadCsv(file.path(), settings);
    EXPECT_EQ(log.position, Eigen::Vector3d(3, 4, 6));
    EXPECT_EQ(log.torque, Eigen::Vector3d(4, 5, 1));
  }
}

TEST(ReadCsv, NeedsNoNameBehindASeparatorAtTheEndOfRows) {
  const TemporaryFile file("log.csv", "0\t1\t2\t\n1\t2\t3\t\n2\t4\t7\t\n");
  ReadSettings settings;
  settings.columns = {"time", "position", "torque"};
  const Measurements log = ReadCsv(file.path(), settings);
  EXPECT_EQ(log.torque, Eigen::Vector3d(2, 3, 7));
}

TEST(ReadCsv, KnowsTheTimeInManySpellings) {
  const std::string rows = "17,0,1,2\n17,500000000,2,3\n18,0,4,7\n";
  for (const char* names : {"sec,nanosec", "header.stamp.sec,header.stamp.nanosec"}) {
    const TemporaryFile file("log.csv", std::string(names) + ",position,torque\n" + rows);
    EXPECT_NEAR(MedianStep(ReadCsv(file.path()).time), .5, 1e-9) << names;
  }
  const TemporaryFile file("log.csv", "__time,position,torque\n0,1,2\n1,2,3\n2,4,7\n");
  EXPECT_EQ(ReadCsv(file.path()).time, Eigen::Vector3d(0, 1, 2));
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

TEST(ReadCsv, UnwrapsARotaryPosition) {
  std::string text = "time,position,torque\n";
  for (int i = 0; i < 100; ++i) text += fmt::format("{},{},{}\n", i, (7 * i) % 360, i % 3);
  ReadSettings layout;
  layout.unit = {{"position", "deg"}};
  const Measurements log = Read(text, layout);
  EXPECT_NEAR(log.position[99], 693 * std::numbers::pi / 180, 1e-12);
  EXPECT_THAT(log.notes, Contains("position jumps by a turn 1 times; unwrapped"));
}

TEST(ReadCsv, MultipliesColumnsByFactors) {
  ReadSettings layout;
  layout.scale = {{"torque", -2}};
  layout.unit = {{"position", "deg"}};
  const std::string text = "time,position,torque\n0,180,1\n1,181,2\n2,182,1\n";
  const Measurements log = Read(text, layout);
  EXPECT_EQ(log.velocity.size(), 0) << "none is in the file";
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

TEST(ReadCsv, RefusesWhatIsNoRecordingAtItsPlace) {
  const std::string header = "time,position,velocity,torque\n", wide(5'000'000, ',');
  const std::string start = header + "0,0,1,1\n\n1,1,1,2\n";
  const std::vector<test::Refused> rows{
      {"", "log.csv", "empty"},
      {"\n \r\n", "log.csv", "empty"},
      {"0,1,2,3\n1,2,3,4\n", "log.csv:1: ", "header"},
      {header, "log.csv", "0 samples"},
      {header + "0,0,1,1\n1,1,1,2\n", "log.csv", "2 samples"},
      // columns
      {"t_s,q_m,q_ref_m,force_N\n0,0,0,1\n1,1,1,2\n2,2,2,3\n",
       "log.csv:1: ", "--map time=t_s,position=q_m,torque=force_N"},
      {"t_s,q_m,speed,force_N\n0,0,0,1\n1,1,1,2\n2,2,2,3\n",
       "log.csv:1: ", "--map time=t_s,position=q_m,velocity=speed,torque=force_N"},
      {"t,q_deg,v_deg,i\n0,0,0,1\n1,1,1,2\n2,2,2,3\n", "log.csv:1: ",
       "--map time=t,position=q_deg,velocity=v_deg,torque=i --unit velocity=deg/s,torque=A"},
      {"t,q,V [V],tau\n0,0,0,1\n1,1,1,2\n2,2,2,3\n",
       "log.csv:1: ", "--map time=t,position=q,torque=tau"},
      {"time,position,velocity,force_N,speed\n0,0,0,1,0\n1,1,1,2,1\n2,2,2,3,2\n",
       "log.csv:1: ", "--map torque=force_N"},
      {"time,position,torque,torque\n0,0,1,1\n", "log.csv:1: ", "'torque'"},
      {"time,position,velocity,torque" + wide + "\n", "log.csv:1: ", "5000004"},
      {header + "0" + wide + "\n", "log.csv:2: ", "5000001"},
      // rows
      {header + "0,0,1,1\n1,1,1,two\n2,2,1,3\n", "log.csv:3: ", "torque is 'two'"},
      {header + "0,0,1,1\n1,1,1,\n2,2,1,3\n", "log.csv", "2 samples"},
      {header + "0,0,1,1\n1,1,1,2\n2,2,1\n", "log.csv", "2 samples"},
      {header + "0,0,1,1\n2,2,1\n1,1,1,2\n", "log.csv:3: ", "3 fields"},
      {header + "0,0,1,1\n1,1,1,2,5\n2,2,1,3\n", "log.csv:3: ", "5 fields"},
      {"time;position;torque\n0;1,000;1,501\n1;1,001;1,502\n2;1,002;1,503\n",
       "log.csv:2: ", "thousands"},
      {"time,position,torque\n0,0,1\n1,1,\"1,002.5\"\n2,2,1\n", "log.csv:3: ", "thousands"},
      {header + "0,0,1,1\n1,1,nan,2\n2,2,1,3\n", "log.csv", "2 samples"},
      {header + "0,0,1,1\n1,1,1,2\n2,-inf,1,3\n", "log.csv:4: ", "position of sample 3 is -inf"},
      {header + "0,0,1,1\n1,1,1,1e999\n2,2,1,3\n", "log.csv:3: ", "torque is '1e999'"},
      // times
      {start + "1,1,1,3\n", "log.csv:5: ", "time 1 s of sample 3"},
      {start + "0.5,1,1,3\n", "log.csv:5: ", "time of sample 3 is 0.5 s"},
      {"time,position,torque\n0,0,1\n1e-300,1,2\n2e-300,2,3\n", "log.csv", "--unit time="},
      {"time,position,torque\n1,0,1\n2e7,1,2\n4e7,2,3\n", "log.csv", "--unit time="},
      {"time,position,torque\n03/04/2024 10:00:00,0,1\n03/04/2024 10:00:01,1,2\n",
       "log.csv:2: ", "--rate"},
      {header + "0,0,1,7\n1,1,1,7\n2,2,1,7\n", "log.csv", "torque is 7 N.m"},
  };
  test::ExpectRefused(rows, [](const std::string& text) { ParseCsv(text, "log.csv"); });
  EXPECT_THROW(ReadCsv("there/is/none.csv"), BadInput);
}

TEST(ReadCsv, RefusesColumnsAndUnitsThatAreNone) {
  const auto refusal = [](auto member, ColumnTexts given) {
    ReadSettings layout;
    layout.*member = std::move(given);
    return Refusal(kPlain, layout);
  };
  const auto map = &ReadSettings::map, unit = &ReadSettings::unit;
  EXPECT_THAT(refusal(map, {{"time", "time"}, {"position", "positon"}}), HasSubstr("'position'"));
  EXPECT_THAT(refusal(map, {{"times", "time"}}), HasSubstr("'time'"));
  EXPECT_THAT(refusal(unit, {{"position", "degg"}}), HasSubstr("deg, "));
  EXPECT_THAT(refusal(unit, {{"position", "counts"}}), HasSubstr("--scale position="));
  EXPECT_THAT(refusal(unit, {{"positon", "deg"}}), HasSubstr("'position'"));
  EXPECT_THAT(refusal(unit, {{"temperature", "K"}}), HasSubstr("temperature"));
}

TEST(ReadCsv, FindsAMappedColumnForNothingElse) {
  ReadSettings layout;
  layout.map = {{"torque", "load"}};
  layout.unit = {{"torque", "raw"}};
  const std::string rows = "0,0,1\n0.1,0.1,2\n0.2,0.2,1\n";
  EXPECT_FALSE(Read("time,position,load\n" + rows, layout).load);
  layout.map = {{"torque", "temp_C"}};
  EXPECT_FALSE(Read("time,position,temp_C\n" + rows, layout).temperature);
  layout.map = {{"torque", "load"}, {"load", "load"}};
  EXPECT_THAT(Refusal("time,position,load\n" + rows, layout), HasSubstr("'load'"));
}

TEST(ReadCsv, AsksForTheUnitOfWhatIsNoTorqueByItsName) {
  const auto read = [](const std::string& name, const ReadSettings& more = {}) {
    ReadSettings layout = more;
    layout.map["torque"] = name;
    return Refusal("time,position," + name + "\n0,0,1\n0.1,0.1,2\n0.2,0.2,1\n", layout);
  };
  for (const auto& [name, unit] :
       std::vector<std::pair<std::string, std::string>>{{"current", "A"},
                                                        {"motorCurrent", "A"},
                                                        {"actual_current_3", "A"},
                                                        {"Iq_measured", "A"},
                                                        {"torque_current", "A"},
                                                        {"i", "A"},
                                                        {"Strom", "A"},
                                                        {"Motorstrom", "A"},
                                                        {"voltage", "V"},
                                                        {"Spannung", "V"},
                                                        {"pwm", "%"},
                                                        {"duty_cycle", "%"},
                                                        {"Present_Load", "%"}}) {
    EXPECT_THAT(read(name), HasSubstr("--unit torque=" + unit)) << name;
    ReadSettings layout;
    layout.unit = {{"torque", unit}};
    EXPECT_EQ(read(name, layout), "accepted") << name;
  }
  ReadSettings scaled;
  scaled.scale = {{"torque", 0.07}};
  EXPECT_EQ(read("Iq_measured", scaled), "accepted");
  for (const char* name : {"tau", "tau_i", "current_torque", "load_torque", "effort", "force",
                           "i_A", "m", "Drehmoment", "motor_voltage_mV"}) {
    EXPECT_EQ(read(name), "accepted") << name;
  }
}

TEST(ReadCsv, KnowsTheOtherJointsOfARobot) {
  const std::string rows = "0,0,9,1\n0.1,0.1,9,2\n0.2,0.2,9,1\n";
  ReadSettings layout;
  layout.map = {{"position", "q_1"}};
  EXPECT_THAT(Read("time,q_1,q_10,torque\n" + rows, layout).other_joints,
              testing::ElementsAre("q_10"));
  EXPECT_THAT(Read("time,q_1,dq_1,torque\n" + rows, layout).other_joints, testing::IsEmpty());
  layout.map = {{"position", "state.q[3]"}};
  EXPECT_THAT(Read("time,state.q[3],state.q[0],torque\n" + rows, layout).other_joints,
              testing::ElementsAre("state.q[0]"));
}

TEST(Units, AreKnownInTheirSpellings) {
  const std::vector<std::string> any;
  for (const auto& [text, name] :
       std::vector<std::pair<std::string, std::string>>{{"rev", "turn"},
                                                        {"rev/s", "turn/s"},
                                                        {"dps", "deg/s"},
                                                        {"1/min", "rpm"},
                                                        {"min^-1", "rpm"},
                                                        {"[°]", "deg"},
                                                        {"°/s", "deg/s"},
                                                        {"rad s^-1", "rad/s"},
                                                        {"N·m", "N.m"},
                                                        {"N*m", "N.m"},
                                                        {"NM", "N.m"},
                                                        {"Nmm", "N.mm"},
                                                        {"cNm", "cN.m"},
                                                        {"kg.cm", "kgf.cm"},
                                                        {"oz-in", "ozf.in"},
                                                        {"µs", "us"},
                                                        {"(ms)", "ms"},
                                                        {"h", "h"},
                                                        {"counts", "counts"}}) {
    const auto unit = MeantUnit(text, any);
    EXPECT_EQ(unit ? std::string(unit->name) : "none", name) << text;
  }
  for (const char* text : {"", "-", "MNm", "x", "N/m", "Mdeg"}) {
    EXPECT_FALSE(MeantUnit(text, any)) << text;
  }
  for (const auto& [text, stem, name] :
       std::vector<std::array<std::string, 3>>{{"Winkel_deg", "Winkel", "deg"},
                                               {"Zeit_ms", "Zeit", "ms"},
                                               {"Moment_mNm", "Moment", "mN.m"},
                                               {"i_A", "i", "A"},
                                               {"speed [rad/s]", "speed", "rad/s"},
                                               {"v_rad_s", "v", "rad/s"},
                                               {"tau (N·m)", "tau", "N.m"},
                                               {"torque", "torque", ""},
                                               {"state.q[0]", "state.q[0]", ""}}) {
    const NameAndUnit split = SplitUnit(text);
    EXPECT_EQ(split.stem, stem);
    EXPECT_EQ(split.unit ? std::string(split.unit->name) : "", name) << text;
  }
}

TEST(ReadStamp, GivesSeconds) {
  for (const auto& [text, seconds] :
       std::vector<std::pair<std::string, double>>{{"1970-01-02T00:00:01.5", 86401.5},
                                                   {"1970-01-02 00:00:01,25", 86401.25},
                                                   {"1970-01-02T01:00:00+01:00", 86400},
                                                   {"19700102T000001.5Z", 86401.5},
                                                   {"02.01.1970 00:00:01", 86401},
                                                   {"12:00:00.123", 43200.123},
                                                   {"12:00:00:123", 43200.123},
                                                   {"1:00:00.5 PM", 46800.5},
                                                   {"12:00:01 AM", 1},
                                                   {"01:02.5", 62.5},
                                                   {"0.02 sec", 0.02},
                                                   {"20 ms", 0.02},
                                                   {"1 days 00:00:01.5", 86401.5}}) {
    const auto stamp = ReadStamp(text);
    EXPECT_NEAR(stamp.value_or(-1), seconds, 1e-9) << text;
  }
  for (const char* text : {"", "12", "12:34", "03/04/2024 10:00:00", "03/04/24 10:00:00",
                           "03.04.24", "24-04-03", "2024-13-01", "10:00:00x", "x", "5 deg"}) {
    EXPECT_FALSE(ReadStamp(text)) << text;
  }
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

constexpr const char* kRows = "0,0,1,10,300\n1,1,1,11,301\n2,2,1,12,302\n";

Measurements ReadWith(const std::string& name, const ReadSettings& layout = {}) {
  return ParseCsv("time,position,velocity,torque," + name + "\n" + kRows, "log.csv", layout);
}

TEST(TemperatureColumn, IsKnownByItsUnit) {
  for (const char* name : {"motor_degC", "case [degC]", "T (degC)", "oil/degC", "temp_K", "T_K",
                           "t [K]", "Temperature (K)"}) {
    EXPECT_TRUE(ReadWith(name).temperature) << name;
  }
  for (const char* name : {"gain_K", "K", "degC", "torques", "", "T_", "BREAK", "speed_of_fan"}) {
    EXPECT_FALSE(ReadWith(name).temperature) << name;
  }
  const char* two =
      "time,position,velocity,torque,a_degC,b_degC\n0,0,1,10,3,3\n1,1,1,1,1,2\n2,2,1,1,1,1\n";
  EXPECT_FALSE(ParseCsv(two, "log.csv").temperature);
}

TEST(TemperatureColumn, IsReadInItsUnit) {
  const Measurements kelvin = ReadWith("case_temp_K");
  ASSERT_TRUE(kelvin.temperature);
  EXPECT_NEAR((*kelvin.temperature)[0], 300 - 273.15, 1e-12);
  ASSERT_EQ(kelvin.notes.size(), 1u);
  EXPECT_EQ(kelvin.notes[0], "temperature from the column 'case_temp_K'");
  EXPECT_EQ((*ReadWith("case_degC").temperature)[0], 300);

  // what is said counts, and what is left out is
  ReadSettings layout;
  layout.unit = {{"temperature", "K"}};
  EXPECT_NEAR((*ReadWith("case_degC", layout).temperature)[0], 300 - 273.15, 1e-12);
  layout = {};
  layout.map = {{"temperature", ""}};
  EXPECT_FALSE(ReadWith("case_degC", layout).temperature);
}

}  // namespace
}  // namespace warmjoint
