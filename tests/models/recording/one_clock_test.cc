// Clocks of tables: one for each column, rows that hold some columns each, episodes, and none at all.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "models/foundation/bad_input.h"
#include "models/recording/read_recording.h"
#include "tests/support/refusal.h"

namespace warmjoint {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A line through 0: what a joint at a constant speed of .5 rad/s is at.
double PositionAt(double time) { return 0.5 * time; }

/// `rows` lines of "time;position;time;torque" between semicolons. The torque is 1 + the time.
std::string Rows(int rows) {
  std::string text;
  for (int i = 0; i < rows; ++i) {
    const double time = 0.1 * i;
    text += fmt::format("{0:.9g};{1:.9g};{0:.9g};{2:.9g}\n", time, PositionAt(time), 1 + time);
  }
  return text;
}

TEST(OneClock, ClocksOfTheirOwnBecomeTheFirst) {
  const std::string rows = Rows(30);
  for (const char* head : {"Name;position;Name;torque\n", "X_Value;position;X_Value;torque\n",
                           "Name;Scope\nFile;x\n\nName;position;Name;torque\nSymbol;;\nSampleTime["
                           "ms];50;SampleTime[ms];50\n",
                           "Time - a;position;Time - b;torque\n", "time;position;time;torque\n"}) {
    SCOPED_TRACE(head);
    const Measurements log = ParseCsv(head + rows, "log.csv");
    ASSERT_EQ(log.size(), 30);
    for (int i = 0; i < 30; ++i) {
      EXPECT_NEAR(log.position[i], PositionAt(log.time[i]), 1e-8);
      EXPECT_NEAR(log.torque[i], 1 + log.time[i], 1e-8);
    }
  }
  // a clock of ours and another stamp stay what they are
  const Measurements ours = ParseCsv("time;position;timestamp;torque\n" + rows, "log.csv");
  EXPECT_EQ(ours.notes.size(), 0u);
  // a temperature is no clock
  const Measurements warm = ParseCsv("time;position;T [degC];torque\n" + rows, "log.csv");
  EXPECT_TRUE(warm.temperature);
}

TEST(OneClock, RowsOfMessagesAreJoinedAtTheTorque) {
  std::string text = "time,position,velocity,torque\n";
  for (int i = 0; i < 50; ++i) {
    text += fmt::format("{:.3f},{:.6f},0.5,\n{:.3f},,,{:.6f}\n", 0.1 * i, PositionAt(0.1 * i),
                        0.1 * i + 0.03, std::sin(i));
  }
  const Measurements log = ParseCsv(text, "log.csv");
  ASSERT_EQ(log.size(), 49) << "the last torque stands behind the last position";
  for (Eigen::Index i = 0; i < log.size(); ++i) {
    EXPECT_NEAR(log.position[i], PositionAt(log.time[i]), 2e-6);
    EXPECT_EQ(log.velocity[i], 0.5);
    EXPECT_NEAR(log.torque[i], std::sin(i), 1e-6);
  }
  EXPECT_THAT(log.notes, Contains(HasSubstr("position, velocity")));
}

TEST(OneClock, NoLineLeadsOverAGap) {
  std::string text = "time,position,torque\n";
  for (int i = 0; i < 60; ++i) {
    if (i == 30) continue;
    // positions are missing for a second
    const double time = 0.1 * i;
    if (i < 20 || i > 30) text += fmt::format("{:.3f},{:.6f},\n", time, i > 30 ? 9 + time : time);
    text += fmt::format("{:.3f},,{:.6f}\n", time + 0.03, std::sin(i));
  }
  const Measurements log = ParseCsv(text, "log.csv");
  EXPECT_GT(log.size(), 40);
  for (Eigen::Index i = 0; i < log.size(); ++i) {
    EXPECT_TRUE(log.time[i] < 2 || log.time[i] > 3) << log.time[i];
  }
}

std::string Episodes(const char* name, int count) {
  std::string text = fmt::format("time,position,torque,{}\n", name);
  for (int k = 0; k < count; ++k) {
    for (int i = 0; i < 20; ++i)
      text += fmt::format("{},{},{},{}\n", 0.1 * i, 0.1 * i, std::sin(i), k);
  }
  return text;
}

TEST(OneClock, EpisodesAreRecordings) {
  const auto recordings = ParseRecordings(Episodes("episode_index", 3), "log.csv");
  ASSERT_EQ(recordings.size(), 3u);
  for (const Measurements& log : recordings) EXPECT_EQ(log.size(), 20);
  // joints one after another are no recordings of one
  EXPECT_THAT(test::RefusalOf([] { ParseRecordings(Episodes("joint", 3), "log.csv"); }),
              HasSubstr("runs backwards"));
  EXPECT_THAT(test::RefusalOf([] { ParseCsv(Episodes("trial", 3), "log.csv"); }),
              HasSubstr("3 episodes"));
}

TEST(OneClock, ATableOfSpeedsIsAListOfHolds) {
  const std::string table = "velocity,torque\n0.5,5\n-0.5,-5.1\n1,5.5\n-1,-5.4\n";
  const Measurements log = ParseCsv(table, "log.csv");
  EXPECT_TRUE(log.position_integrated);
  EXPECT_EQ(log.size() % 4, 0);
  EXPECT_EQ(log.velocity[0], 0.5);
  EXPECT_EQ(log.velocity[log.size() - 1], -1);
  EXPECT_THAT(log.doubts, ElementsAre(HasSubstr("--rate HZ")));
  // samples, by what is said or by their number
  ReadSettings rate;
  rate.rate = 100;
  EXPECT_EQ(ParseCsv(table, "log.csv", rate).size(), 4);
  std::string samples = "velocity,torque\n";
  for (int i = 0; i < 2000; ++i) samples += fmt::format("{},{}\n", 0.5, std::sin(i));
  EXPECT_THAT(test::RefusalOf([&] { ParseCsv(samples, "log.csv"); }), HasSubstr("--rate HZ"));
}

TEST(OneClock, NotesAndDoubtsReadBack) {
  const Measurements log = ParseCsv("velocity,torque\n0.5,5\n-0.5,-5.1\n1,5.5\n-1,-5.4\n", "a.csv");
  const Measurements copy = ParseCsv(RecordingToCsv(log), "a.csv");
  EXPECT_EQ(copy.notes, log.notes);
  EXPECT_EQ(copy.doubts, log.doubts);
  EXPECT_EQ(copy.torque, log.torque);
}

TEST(ParseTable, KeepsColumnsOfNumbersAndNamesTheRest) {
  const FileContent content =
      ParseTable("t_s\tq [deg]\tstate\tnote\n0\t1\trun\t\n1\t2\trun\t\n2\t3\tOVF\t\n", "sheet");
  std::vector<std::string> names;
  for (const FileColumn& column : content.columns) names.push_back(column.name);
  EXPECT_THAT(names, ElementsAre("t_s", "q [deg]", "note"));
  EXPECT_THAT(content.notes, ElementsAre(HasSubstr("column 'state'")));
  EXPECT_THAT(
      test::RefusalOf([] { ParseTable("time;torque\n0;1,501\n1;1,502\n2;1,503\n", "sheet"); }),
      HasSubstr("thousands"));
}

}  // namespace
}  // namespace warmjoint
