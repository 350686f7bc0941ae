#include "models/recording/clock.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "models/foundation/bad_input.h"
#include "models/recording/read_recording.h"

namespace warmjoint {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

constexpr double kMinute = 60, kHour = 3600, kSpeed = 0.5;  // s, s, rad/s

/// 400 samples of a joint at 0.5 rad/s there and back, at times that a file has. times: [N] as they stand in it; step: s
std::string Log(const std::vector<std::string>& times, double step, bool has_velocity) {
  std::string text = has_velocity ? "time,position,velocity,torque\n" : "time,position,torque\n";
  double position = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double velocity = i / 100 % 2 == 0 ? kSpeed : -kSpeed;
    position += velocity * step;
    text += fmt::format("{},{:.12g},", times[i], position);
    if (has_velocity) text += fmt::format("{},", velocity);
    text += fmt::format("{}\n", velocity > 0 ? 4.9 + 0.01 * static_cast<double>(i % 7) : -4.9);
  }
  return text;
}

/// Stamps of a counter that begins at an age, s. counts: a second
std::vector<std::string> Counter(double age, double counts, double step) {
  std::vector<std::string> times;
  for (int i = 0; i < 400; ++i)
    times.push_back(fmt::format("{:.0f}", std::floor((age + i * step) * counts)));
  return times;
}

/// The median step of a log as it is read, s; nothing where it is refused by the unit of time.
std::optional<double> StepRead(const std::string& text) {
  try {
    const Measurements log = ParseCsv(text, "log.csv");
    return (log.time[399] - log.time[0]) / 399;
  } catch (const BadInput& refusal) {
    EXPECT_THAT(refusal.what(), HasSubstr("--unit time="));
    return std::nullopt;
  }
}

TEST(Clock, OfACounterIsRightOrAskedAbout) {
  for (const double counts : {1e3, 1e6}) {
    for (const double age :
         {10 * kMinute, kHour, 30 * kHour, 240 * kHour, 480 * kHour, 1200 * kHour}) {
      for (const double rate : {10, 50, 100, 500, 1000, 5000, 20000}) {
        for (const bool has_velocity : {true, false}) {
          const double step = 1 / rate;
          const auto read = StepRead(Log(Counter(age, counts, step), step, has_velocity));
          EXPECT_NEAR(read.value_or(step), step, 0.1 * step)
              << counts << " a second, " << age << " s, " << rate << " Hz, velocity "
              << has_velocity;
        }
      }
    }
  }
}

TEST(Clock, SinceNineteenSeventyIsRead) {
  for (const double rate : {2, 20, 50, 1000}) {
    const double step = 1 / rate;
    for (const double counts : {1e3, 1e6}) {
      for (const bool has_velocity : {true, false}) {
        const std::string text = Log(Counter(1.7e9, counts, step), step, has_velocity);
        EXPECT_NEAR(StepRead(text).value_or(0), step, 0.02 * step) << rate << " Hz, " << counts;
        // that it may be another count is said where no velocity tells
        const Measurements log = ParseCsv(text, "log.csv");
        EXPECT_THAT(log.notes, Contains(HasSubstr("since 1970")));
        EXPECT_EQ(log.doubts.empty(), has_velocity);
      }
    }
    std::vector<std::string> seconds;
    for (int i = 0; i < 400; ++i) seconds.push_back(fmt::format("{:.6f}", 1.7e9 + i * step));
    EXPECT_NEAR(StepRead(Log(seconds, step, false)).value_or(0), step, 1e-3 * step) << rate;
  }
}

TEST(Clock, GoesOnWhereItsCounterStartsAgain) {
  for (const double range : {std::exp2(16), std::exp2(24), std::exp2(32)}) {
    Eigen::VectorXd counts(400);
    for (int i = 0; i < 400; ++i) counts[i] = std::fmod(range - 2000 + 20.0 * i, range);
    Eigen::VectorXd thousandths = 1e-3 * counts;
    EXPECT_THAT(UndoRestarts(counts), HasSubstr(fmt::format("{:.10g}", range)));
    EXPECT_EQ(counts[399], range - 2000 + 20.0 * 399);
    EXPECT_NE(UndoRestarts(thousandths), "");
    EXPECT_NEAR(thousandths[399], 1e-3 * counts[399], 1e-6);
  }
  // two logs in a file
  Eigen::VectorXd logs = Eigen::VectorXd::LinSpaced(400, 0, 399);
  logs.tail(200) = logs.head(200);
  const Eigen::VectorXd before = logs;
  EXPECT_EQ(UndoRestarts(logs), "");
  EXPECT_EQ(logs, before);
}

TEST(Clock, LeavesOutRowsThatAreNotOnIt) {
  const auto with = [](const std::string& first, const std::string& last) {
    std::string text = "time,position,velocity,torque\n" + first;
    for (int i = 0; i < 400; ++i)
      text += fmt::format("{},{},0.5,{}\n", 5 + 0.01 * i, 0.005 * i, i % 7);
    return ParseCsv(text + last, "log.csv");
  };
  EXPECT_EQ(with("", "").size(), 400);
  EXPECT_THAT(with("", "").notes, testing::IsEmpty());
  // factors, channel numbers, and a sum
  for (const char* row : {"1,0.001,0.01,0.1\n", "900,1,2,3\n"}) {
    const Measurements log = with(row, "");
    EXPECT_EQ(log.size(), 400) << row;
    EXPECT_THAT(log.notes, Contains(HasSubstr("the first row")));
    EXPECT_EQ(log.time[0], 5);
  }
  const Measurements log = with("", "400,0,0,0\n");
  EXPECT_EQ(log.size(), 400);
  EXPECT_THAT(log.notes, Contains(HasSubstr("the last row")));
}

TEST(Clock, WithoutAYearIsRefused) {
  // over midnight, day and month in either order, two digits of a year
  for (const char* form :
       {"{:02}/04/24 {}", "04/{:02}/24 {}", "{:02}.04.24 {}", "24-04-{:02} {}"}) {
    std::string text = "time,position,torque\n";
    for (int i = 0; i < 40; ++i) {
      const int day = i < 20 ? 3 : 4;
      const std::string clock =
          i < 20 ? fmt::format("23:59:59.{:02}", 80 + i) : fmt::format("00:00:00.{:02}", i - 20);
      text +=
          fmt::format(fmt::runtime(form), day, clock) + fmt::format(",{},{}\n", 0.01 * i, i % 7);
    }
    EXPECT_THROW(ParseCsv(text, "log.csv"), BadInput) << form;
  }
}

}  // namespace
}  // namespace warmjoint
