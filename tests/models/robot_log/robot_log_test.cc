// A robot's wide log: one clock, and each column by its own rule.
#include "models/robot_log/robot_log.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/models/recording/temporary_file.h"
#include "tests/support/refusal.h"

namespace warmjoint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kRows = 200;

/// What stands in the cells of a row, behind its time.
using Cells = std::function<std::string(int row)>;

/// A table with a clock of 20 ms and columns q0, q1, tau0, tau1; tau: cells of the second torque.
std::string TableOf(
    const Cells& tau, const std::string& time = "time",
    const Cells& clock = [](int i) { return fmt::format("{:.6g}", .02 * i); }) {
  std::string text = time + ",q0,q1,tau0,tau1\n";
  for (int i = 0; i < kRows; ++i) {
    text += fmt::format("{},{:.6g},{:.6g},{:.6g},{}\n", clock(i), std::sin(.03 * i),
                        .5 * std::cos(.02 * i), 3 * std::cos(.03 * i), tau(i));
  }
  return text;
}

std::string Torque(int i) { return fmt::format("{:.6g}", 2 * std::sin(.02 * i)); }

RobotLog Read(const RobotLogSource& source) {
  const std::vector<std::string> joints{"lift", "elbow"};
  RobotColumns columns;
  const FindLogColumns find = [&](const FileContent& content, const Place& place) {
    std::vector<std::string> names;
    for (const FileColumn& column : content.columns) names.push_back(column.name);
    return columns = FindRobotColumns(names, joints, {}, place);
  };
  FileContent content = ReadRobotTable(source, {}, find);
  find(content, {source.name});
  return ReadRobotLog(source.name, std::move(content), {}, columns,
                      {JointKind::rotary, JointKind::rotary});
}

RobotLog ReadText(const std::string& text) { return Read({.name = "log.csv", .text = text}); }

std::string RefusalOfText(const std::string& text) {
  return test::RefusalOf([&] { ReadText(text); });
}

TEST(RobotLog, ReadsAFileAsTheSameTextInMemory) {
  const std::string text = TableOf(Torque);
  const TemporaryFile file("log.csv", text);
  const RobotLog of_file = Read({.name = file.path()}), of_text = ReadText(text);
  EXPECT_EQ(of_file.time.size(), kRows);
  EXPECT_EQ(of_file.position, of_text.position);
  EXPECT_EQ(of_file.torque, of_text.torque);
  EXPECT_TRUE(of_file.logged.all());
  EXPECT_THAT(of_file.dead, ElementsAre("", ""));
  EXPECT_NEAR(of_file.torque(100, 1), 2 * std::sin(2.0), 1e-4);
}

TEST(RobotLog, ATorqueThatCannotBeUsedLeavesItsJointAloneOut) {
  const std::pair<Cells, const char*> useless[]{
      {[](int) { return "0"; }, "is 0 N.m in all 200 samples"},
      {[](int) { return "nan"; }, "has no row with a number"},
      {[](int) { return ""; }, "has no row with a number"},
      {[](int i) { return i == 7 ? "OVF" : "1"; }, "log.csv:9: tau1 is 'OVF'"},
      {[](int i) { return i == 7 ? "1e40" : Torque(i); }, "of sample 8 is 1e+40"}};
  for (const auto& [cells, why] : useless) {
    const RobotLog log = ReadText(TableOf(cells));
    EXPECT_THAT(log.dead, ElementsAre("", HasSubstr(why)));
    EXPECT_TRUE(log.logged.col(0).all());
    EXPECT_FALSE(log.logged.col(1).any());
    EXPECT_EQ(log.position, ReadText(TableOf(Torque)).position);
  }
}

TEST(RobotLog, NumbersThatLackInATorqueAreLeftOutThereAlone) {
  // single samples, and ten in a row
  const RobotLog log =
      ReadText(TableOf([](int i) { return i % 9 == 4 || (i >= 50 && i < 60) ? "" : Torque(i); }));
  EXPECT_THAT(log.dead, ElementsAre("", ""));
  EXPECT_TRUE(log.logged.col(0).all());
  EXPECT_FALSE(log.logged(55, 1));
  EXPECT_TRUE(log.logged(13, 1));
  EXPECT_NEAR(log.torque(13, 1), 2 * std::sin(.26), 1e-3);
}

TEST(RobotLog, RefusesTheClockByItsOwnReason) {
  EXPECT_THAT(RefusalOfText(TableOf(
                  Torque, "time", [](int i) { return fmt::format("{:.6g}", .02 * (kRows - i)); })),
              HasSubstr("it runs backwards"));
  EXPECT_THAT(RefusalOfText(TableOf(Torque, "time", [](int i) { return i == 3 ? "later" : "1"; })),
              HasSubstr("log.csv:5: time is 'later'"));
  std::string position = TableOf(Torque);
  position.replace(position.find(",0.5,"), 5, ",low,");
  EXPECT_THAT(RefusalOfText(position), HasSubstr("log.csv:2: q1 is 'low'"));
}

TEST(RobotLog, KnowsTheTimeInManySpellings) {
  const RobotLog usual = ReadText(TableOf(Torque));
  for (const char* name : {"__time", "/header/time", "Timestamp [s]", "t", "stamp"}) {
    EXPECT_EQ(ReadText(TableOf(Torque, name)).time, usual.time) << name;
  }
  const auto parts = [](int i) { return fmt::format("17{},{}", i / 50, i % 50 * 20'000'000); };
  for (const char* names : {"sec,nanosec", "header.stamp.sec,header.stamp.nanosec", "secs,nsecs",
                            "stamp_sec,stamp_nanosec", "Stamp/Secs,Stamp/Nsecs"}) {
    const RobotLog log = ReadText(TableOf(Torque, names, parts));
    EXPECT_EQ(log.time.size(), kRows) << names;
    EXPECT_NEAR(log.step, .02, 1e-9) << names;
  }
}

TEST(RobotLog, RefusesColumnsOfDifferentLengths) {
  FileContent columns;
  for (const char* name : {"time", "q0", "q1", "tau0", "tau1"}) {
    columns.columns.push_back({name, "", Eigen::VectorXd::LinSpaced(kRows, 0, 4)});
  }
  columns.columns[3].values.conservativeResize(kRows - 1);
  EXPECT_THAT(test::RefusalOf([&] { Read({.name = "log", .columns = columns}); }),
              HasSubstr("tau0 has 199 samples where time has 200"));
}

}  // namespace
}  // namespace warmjoint
