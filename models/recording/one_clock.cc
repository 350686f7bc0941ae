#include "models/recording/one_clock.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/robust_noise.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Values = Eigen::VectorXd;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
// why: a person sets some hundred speeds at most, and a drive logs a thousand samples in some seconds
constexpr Index kMostHolds = 1000;
// why: a segment of constant speed needs a few samples; they are equal, so that more of them tell nothing more
constexpr Index kSamplesOfHold = 10;
constexpr double kStepOfHold = 0.05;  // s
// why: fewer samples are a clock that slipped, which is mended as such
constexpr std::size_t kShortestEpisode = 10;

/// The steps by which a recording begins again: its clock is at its start, as far as two steps tell.
std::vector<std::size_t> StartsAgain(const Values& time) {
  std::vector<std::size_t> starts{0};
  if (time.size() < 2) return starts;
  const Values steps = time.tail(time.size() - 1) - time.head(time.size() - 1);
  const double step = MedianOf(steps);
  for (Index i = 1; i < time.size(); ++i) {
    const bool is_back = time[i] < time[i - 1] && time[i] <= time[0] + 2 * step;
    if (!is_back) continue;
    if (static_cast<std::size_t>(i) - starts.back() < kShortestEpisode) return {0};
    starts.push_back(static_cast<std::size_t>(i));
  }
  if (static_cast<std::size_t>(time.size()) - starts.back() < kShortestEpisode) return {0};
  return starts;
}

/// Samples first to end - 1 of each column.
RawColumns Part(const RawColumns& raw, std::size_t first, std::size_t end) {
  RawColumns part = raw;
  const auto begin = static_cast<Index>(first), count = static_cast<Index>(end - first);
  for (ColumnSource& one : part.columns) one.values = Values(one.values.segment(begin, count));
  if (!raw.line.empty()) {
    part.line.assign(raw.line.begin() + begin, raw.line.begin() + begin + count);
  }
  return part;
}

/// The samples of one column that have a number.
struct Series {
  std::vector<double> time, value;
  double longest = 0;  // step of time that is no gap
  double jump = 0;     // step of the value that is no motion: a sensor starts its turn again
};

/// wraps: whether the column may start again behind its range.
Series SeriesOf(const Values& time, const Values& values, bool wraps) {
  Series series;
  for (Index i = 0; i < std::min(time.size(), values.size()); ++i) {
    if (std::isnan(time[i]) || std::isnan(values[i])) continue;
    series.time.push_back(time[i]);
    series.value.push_back(values[i]);
  }
  series.jump = std::numeric_limits<double>::infinity();
  if (series.time.size() < 2) return series;
  series.longest = LongestStep(Values::Map(series.time.data(), std::ssize(series.time)));
  const auto [least, most] = std::ranges::minmax(series.value);
  if (wraps) series.jump = (most - least) / 2;
  return series;
}

/// The value at each of `times`, which ascend as the series does; NaN where no line leads there.
Values At(const Values& times, const Series& series) {
  Values values(times.size());
  const auto last = std::ssize(series.time) - 1;
  std::ptrdiff_t k = 0;  // the sample at or before the time
  for (Index i = 0; i < times.size(); ++i) {
    values[i] = kNaN;
    if (last < 0 || !(times[i] >= series.time[0])) continue;
    if (times[i] < series.time[k]) k = 0;
    while (k < last && series.time[k + 1] <= times[i]) ++k;
    const double before = series.time[k], value = series.value[k];
    if (times[i] == before) values[i] = value;
    if (times[i] == before || k == last) continue;
    const double step = series.time[k + 1] - before, rise = series.value[k + 1] - value;
    // a value that is the same at both ends of a gap was held
    const bool is_line = (step <= series.longest && std::abs(rise) <= series.jump) || rise == 0;
    if (is_line) values[i] = value + rise * (times[i] - before) / step;
  }
  return values;
}

bool IsLetter(unsigned char c) { return std::isalpha(c) || c >= 0x80; }

/// The letters with which a name begins: what the clocks of a file have in common.
std::string FirstWord(const std::string& name) {
  return Lowercase(std::string(name.begin(), std::ranges::find_if_not(name, IsLetter)));
}

/// Whether a column is called as clocks are. TwinCAT calls each "Name".
bool IsClock(const std::string& name) {
  constexpr std::array<std::string_view, 6> words{"timestamp", "time",    "zeit",
                                                  "x_value",   "x-value", "t"};
  const std::string lower = Lowercase(name);
  const bool is_called_so = std::ranges::any_of(words, [&](std::string_view word) {
    return lower.starts_with(word) &&
           (lower.size() == word.size() || !IsLetter(lower[word.size()]));
  });
  // T [degC] is a temperature
  const NameAndUnit split = SplitUnit(name);
  return lower == "name" || (is_called_so && (!split.unit || split.unit->base == "s"));
}

/// The unit of a clock by its row of units or its name; nothing where neither says one.
std::optional<Unit> UnitOfClock(const FileColumn& clock) {
  const std::optional<Unit> said = MeantUnit(clock.unit, {"s"});
  return said ? said : SplitUnit(clock.name, {"s"}).unit;
}

/// Positions of the clocks.
std::vector<std::size_t> ClocksOf(const std::vector<std::string>& names) {
  std::vector<std::size_t> clocks;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (IsClock(names[i])) clocks.push_back(i);
  }
  return clocks;
}

std::vector<std::string> NamesOf(const FileContent& content) {
  std::vector<std::string> names;
  for (const FileColumn& column : content.columns) names.push_back(column.name);
  return names;
}

}  // namespace

bool HasSeveralClocks(const std::vector<std::string>& names) {
  const std::vector<std::size_t> clocks = ClocksOf(names);
  if (clocks.size() < 2 || clocks.front() != 0 || clocks.back() + 1 >= names.size()) return false;
  const auto neighbours = [](std::size_t a, std::size_t b) { return b == a + 1; };
  if (std::ranges::adjacent_find(clocks, neighbours) != clocks.end()) return false;
  // one kind of name; where they differ, none is the log's own time
  bool are_equal = true, is_ours = false;
  for (const std::size_t i : clocks) {
    if (FirstWord(names[i]) != FirstWord(names[0])) return false;
    are_equal = are_equal && names[i] == names[0];
    is_ours = is_ours || Lowercase(SplitUnit(names[i]).stem) == "time";
  }
  return are_equal || !is_ours;
}

FileContent OnOneClock(FileContent content) {
  const std::vector<std::string> names = NamesOf(content);
  // a clock of texts was left out
  if (!HasSeveralClocks(names)) return content;
  const Values& first = content.columns.front().values;
  FileContent joined{.joint = content.joint, .gear = content.gear, .notes = content.notes};
  // each clock in the unit of the first, where both have one
  const std::optional<Unit> unit = UnitOfClock(content.columns.front());
  joined.columns.push_back(
      {"time", unit ? std::string(unit->name) : content.columns.front().unit, first});
  std::vector<std::string> empty, put;
  std::size_t clock = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (IsClock(names[i])) clock = i;
    if (clock == i) continue;
    const std::optional<Unit> own = UnitOfClock(content.columns[clock]);
    const double in_first = unit && own ? own->factor / unit->factor : 1;
    const Series series =
        SeriesOf(in_first * content.columns[clock].values, content.columns[i].values, false);
    if (series.time.size() < 2) {
      empty.push_back(names[i]);
      continue;
    }
    FileColumn& column = joined.columns.emplace_back(std::move(content.columns[i]));
    if (clock == 0) continue;
    put.push_back(names[i]);
    column.values = At(first, series);
  }
  if (!empty.empty()) {
    joined.notes.push_back(fmt::format("{} without numbers are left out", ExcerptOfList(empty)));
  }
  joined.notes.push_back(
      fmt::format("columns have clocks of their own: {} are put on the first clock by straight "
                  "lines between samples",
                  ExcerptOfList(put)));
  return joined;
}

void JoinRows(RawColumns& raw) {
  const std::string_view time_name = RecordingColumns().front().name;
  const auto torque = std::ranges::find(raw.columns, std::string_view("torque"),
                                        [](const auto& one) { return one.column->name; });
  if (raw.columns.front().column->name != time_name || torque == raw.columns.end()) return;
  if (raw.columns.size() > 1 && raw.columns[1].is_added) return;

  // rows with a torque, and those of them that have all else that a log needs
  const Values time = raw.columns.front().values;
  std::vector<Index> rows;
  Index complete = 0;
  for (Index i = 0; i < time.size(); ++i) {
    if (std::isnan(time[i]) || std::isnan(torque->values[i])) continue;
    rows.push_back(i);
    complete += std::ranges::all_of(raw.columns, [i](const ColumnSource& one) {
      return !one.column->required || !std::isnan(one.values[i]);
    });
  }
  const bool has_position = std::ranges::any_of(
      raw.columns, [](const auto& one) { return one.column->name == "position"; });
  const auto velocity = std::ranges::find(raw.columns, std::string_view("velocity"),
                                          [](const auto& one) { return one.column->name; });
  if (!has_position && velocity != raw.columns.end()) {
    complete =
        std::ranges::count_if(rows, [&](Index i) { return !std::isnan(velocity->values[i]); });
  }
  if (2 * complete > std::ssize(rows) || rows.size() < 3) return;

  // the rest at their times
  std::vector<std::string> put;
  const Values times = time(rows);
  const double most = 2 * static_cast<double>(rows.size());
  for (ColumnSource& one : raw.columns) {
    const std::string& name = one.column->name;
    const Index count = one.values.size() - one.values.array().isNaN().count();
    const bool is_known = name == time_name || &one == &*torque;
    const bool is_angle = name == "position" || name == "motor_position";
    const bool is_slow = name == "temperature" && count > 1;
    const bool takes_part =
        one.column->required || is_slow || 4 * static_cast<double>(count) >= most;
    if (is_known || !takes_part) {
      one.values = Values(one.values(rows));
      continue;
    }
    Series series = SeriesOf(time, one.values, is_angle);
    if (is_slow) series.longest = std::numeric_limits<double>::infinity();
    one.values = At(times, series);
    put.push_back(name);
  }
  if (!raw.line.empty()) {
    std::vector<int> lines;
    for (const Index i : rows) lines.push_back(raw.line[static_cast<std::size_t>(i)]);
    raw.line = std::move(lines);
  }
  raw.notes.push_back(fmt::format(
      "{} of {} rows hold a torque, in other rows than {}: these are put at its times by straight "
      "lines between their samples",
      rows.size(), time.size(), fmt::join(put, ", ")));
}

std::vector<RawColumns> Episodes(RawColumns raw, const std::vector<FileColumn>& columns) {
  constexpr std::array<std::string_view, 4> words{"episode", "trial", "demo", "rollout"};
  const bool has_episodes = std::ranges::any_of(columns, [&](const FileColumn& column) {
    const std::string name = Lowercase(column.name);
    return std::ranges::any_of(
        words, [&](std::string_view word) { return name.find(word) != std::string::npos; });
  });
  const bool is_timed = raw.columns.front().column->name == RecordingColumns().front().name;
  std::vector<std::size_t> starts{0};
  if (has_episodes && is_timed && !raw.columns.front().in_words)
    starts = StartsAgain(raw.columns.front().values);
  std::vector<RawColumns> episodes;
  if (starts.size() == 1) {
    episodes.push_back(std::move(raw));
    return episodes;
  }
  raw.notes.push_back(
      fmt::format("the clock begins anew {} times: {} episodes, each a recording of its own",
                  starts.size() - 1, starts.size()));
  starts.push_back(static_cast<std::size_t>(raw.columns.front().values.size()));
  for (std::size_t k = 0; k + 1 < starts.size(); ++k) {
    episodes.push_back(Part(raw, starts[k], starts[k + 1]));
    raw.notes.clear();
  }
  return episodes;
}

void MakeHolds(RawColumns& raw) {
  const Index rows = raw.columns.front().values.size();
  if (rows > kMostHolds) {
    Refuse({raw.file},
           "has no time, and {} rows are samples rather than held speeds; give --rate HZ, the "
           "samples in a second",
           rows);
  }
  // each row again and again, on a clock that is made
  for (ColumnSource& one : raw.columns) {
    one.values = Values(one.values.transpose().replicate(kSamplesOfHold, 1).reshaped());
  }
  std::vector<int> lines;
  for (const int line : raw.line) lines.insert(lines.end(), kSamplesOfHold, line);
  raw.line = std::move(lines);
  ColumnSource time{.column = &RecordingColumns().front(), .unit_from = UnitFrom::option};
  time.unit = *MeantUnit("s");
  const Index count = rows * kSamplesOfHold;
  time.values = kStepOfHold * Values::LinSpaced(count, 0, static_cast<double>(count - 1));
  raw.columns.insert(raw.columns.begin(), std::move(time));
  raw.doubts.push_back(fmt::format(
      "the file has no time: each of its {} rows counts as a speed that was held; if they are "
      "samples give --rate HZ",
      rows));
  raw.notes.push_back(raw.doubts.back());
}

}  // namespace warmjoint
