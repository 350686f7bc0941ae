// The clock of a recording: stamps in words, epochs, coarse ticks.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "models/recording/units.h"

namespace warmjoint {

/// The seconds of a stamp: since 1970 of a date with or without a time, as 2024-03-01T12:00:00.123+01:00 or "01.03.2024 12:00:00";
/// since midnight of a time, as 12:00:00.123, 12:00:00:123, "1:00:00 PM" or 59:59.9; of a duration, as "0.02 sec", "20 ms" or
/// "0 days 00:00:01.5". Nothing for other texts, plain numbers, and dates of which no one knows the month, as 03/04/2024.
std::optional<double> ReadStamp(std::string_view text);

/// The part of a second that a plain count is in, where its size is that of a time since 1970: "s", "ms", "us" or "ns" of years
/// from 2001 to 2100 at more than a sample in 100 s. Nothing for other counts. time: [N]
std::optional<Unit> EpochUnit(const Eigen::VectorXd& time);

/// What was made of a clock.
struct MendedClock {
  std::vector<bool>
      keep;  // [N] false for few samples whose stamp is that of the one before, or earlier; empty: all
  std::string note;  // what was done; empty where nothing was
};

/// Makes time increase where a clock is coarse or made a slip. Stamps that repeat more often than once in 100 samples are ticks,
/// within which samples are spread evenly; fewer that repeat or step back are to be left out. Times of day go on behind midnight.
/// Leaves all other clocks as they are. time: [N] s, changed in place; position: [N], by which rows of several joints at one stamp
/// are told from ticks.
MendedClock MendClock(const Eigen::VectorXd& position, bool is_time_of_day, Eigen::VectorXd& time);

}  // namespace warmjoint
