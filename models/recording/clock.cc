#include "models/recording/clock.h"

#include <fmt/format.h>
#include <strings.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <ctime>
#include <utility>

#include "models/foundation/robust_noise.h"
#include "models/recording/sampling.h"
#include "models/recording/units.h"

namespace warmjoint {
namespace {

constexpr double kDay = 86400;  // s
constexpr Eigen::Index kFewInAll =
    100;  // one sample in so many may go: that moves no estimate by more than its noise does
constexpr std::size_t kFewestTicks = 10;  // that tell the step of a clock to a tenth

/// Dates and times, as strptime reads them; a fraction of a second and a zone may follow.
constexpr const char* kStamps[]{"%Y-%m-%dT%H:%M:%S", "%Y-%m-%d %H:%M:%S", "%Y/%m/%d %H:%M:%S",
                                "%d.%m.%Y %H:%M:%S", "%Y%m%dT%H%M%S",     "%Y-%m-%d_%H:%M:%S",
                                "%Y-%m-%d",          "%d.%m.%Y",          "%H:%M:%S"};

/// The text behind what `format` reads of a stamp; nullptr where it does not.
const char* Behind(const char* text, const char* format, std::tm* time) {
  *time = {};
  time->tm_year = 70;
  time->tm_mday = 1;
  return strptime(text, format, time);
}

double Median(const std::vector<double>& values) {
  Eigen::VectorXd x =
      Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  return MedianInPlace(x);
}

/// Where the samples of each stamp begin, and the number of samples behind the last.
std::vector<Eigen::Index> TicksOf(const Eigen::VectorXd& time) {
  std::vector<Eigen::Index> begin{0};
  for (Eigen::Index i = 1; i < time.size(); ++i) {
    if (time[i] != time[i - 1]) begin.push_back(i);
  }
  begin.push_back(time.size());
  return begin;
}

/// Whether rows of one stamp are further apart than rows of one place in neighbouring ticks: they are of several joints.
bool AreSeveral(const Eigen::VectorXd& position, const std::vector<Eigen::Index>& begin) {
  std::vector<double> within, between;
  for (std::size_t k = 0; k + 2 < begin.size() && position.size() > 0; ++k) {
    between.push_back(std::abs(position[begin[k + 1]] - position[begin[k]]));
    if (begin[k] + 1 < begin[k + 1]) {
      within.push_back(std::abs(position[begin[k] + 1] - position[begin[k]]));
    }
  }
  // in ticks the first is a part of the second; noise makes both alike
  return !within.empty() && Median(within) > 2 * Median(between);
}

/// Spreads the samples of each tick evenly over it.
std::string SpreadTicks(const std::vector<Eigen::Index>& begin, Eigen::VectorXd& time) {
  // how long ticks are, and the steps of their samples
  const std::size_t ticks = begin.size() - 1;
  std::vector<double> lengths, steps;
  for (std::size_t k = 0; k + 1 < ticks; ++k) {
    lengths.push_back(time[begin[k + 1]] - time[begin[k]]);
    steps.push_back(lengths.back() / static_cast<double>(begin[k + 1] - begin[k]));
  }
  const double tick = Median(lengths), step = Median(steps);

  Eigen::VectorXd even(time.size());
  for (std::size_t k = 0; k < ticks; ++k) {
    const auto count = static_cast<double>(begin[k + 1] - begin[k]);
    const bool is_last = k + 1 == ticks || lengths[k] > kGapSteps * tick;
    const bool is_first = k == 0 || lengths[k - 1] > kGapSteps * tick;
    // the log may begin within a tick, and end within one
    const double h = is_last || (is_first && count * step < lengths[k]) ? step : lengths[k] / count;
    const double start =
        is_first && !is_last ? time[begin[k]] + lengths[k] - count * h : time[begin[k]];
    for (Eigen::Index i = begin[k]; i < begin[k + 1]; ++i) {
      even[i] = start + h * static_cast<double>(i - begin[k]);
    }
  }
  time = std::move(even);
  return fmt::format(
      "its clock ticks every {:.4g} s, for {:.3g} samples each; they are spread evenly over it",
      tick, static_cast<double>(time.size()) / static_cast<double>(ticks));
}

}  // namespace

std::optional<double> ReadStamp(std::string_view text) {
  if (text.empty() || text.size() > 48 || text[0] < '0' || text[0] > '9') return std::nullopt;
  std::string stamp(text);
  std::ranges::replace(stamp, ',', '.');
  // a duration: a number and its unit, or days and a time
  const char* const end = stamp.data() + stamp.size();
  double number = 0;
  const std::string_view unit(std::from_chars(stamp.data(), end, number).ptr, end);
  if (unit.empty()) return std::nullopt;
  // none begins as the rest of a date or a time does
  const bool is_clock = unit.find_first_of("-:/.T") == 0;
  const std::optional<Unit> known = is_clock ? std::nullopt : MeantUnit(unit, {"s"});
  if (known) return number * known->factor;
  for (const std::string_view days : {" days ", " day "}) {
    const auto rest = unit.starts_with(days) ? ReadStamp(unit.substr(days.size())) : std::nullopt;
    if (rest) return number * kDay + *rest;
  }

  // a date, a time, or both; minutes and seconds alone only with a fraction
  std::tm time{};
  const char* rest = nullptr;
  for (const char* format : kStamps) {
    if (!rest) rest = Behind(stamp.c_str(), format, &time);
  }
  if (!rest) {
    rest = Behind(stamp.c_str(), "%M:%S", &time);
    if (rest && *rest != '.') rest = nullptr;
  }
  if (!rest) return std::nullopt;
  double seconds = static_cast<double>(timegm(&time));
  // milliseconds may follow a colon
  if (*rest == ':' || *rest == '.') {
    double fraction = 0;
    const char* const digits = rest + 1;
    rest = std::from_chars(digits, end, fraction, std::chars_format::fixed).ptr;
    if (fraction < 0 || rest == digits) return std::nullopt;
    const bool is_milli = digits[-1] == ':';
    seconds += fraction * std::pow(10, is_milli ? -3 : static_cast<double>(digits - rest));
  }
  // morning or afternoon, and the zone
  const double hour = 3600.0 * (time.tm_hour % 12 - time.tm_hour);
  while (*rest == ' ') ++rest;
  for (const auto& [half, hours] : {std::pair("AM", 0), std::pair("PM", 12)}) {
    if (strncasecmp(rest, half, 2) != 0) continue;
    seconds += hour + 3600 * hours;
    rest += 2;
  }
  std::tm zone{};
  if (const char* behind = *rest ? Behind(rest, "%z", &zone) : nullptr) {
    seconds -= static_cast<double>(zone.tm_gmtoff);
    rest = behind;
  }
  return *rest ? std::nullopt : std::optional(seconds);
}

std::optional<Unit> EpochUnit(const Eigen::VectorXd& time) {
  constexpr double first = 978307200, last = 4102444800;  // s, of 2001 and 2100
  constexpr double longest = 100;                         // s between samples
  const Eigen::Index n = time.size();
  if (n < 2) return std::nullopt;
  const double step = (time[n - 1] - time[0]) / static_cast<double>(n - 1);
  for (const char* name : {"s", "ms", "us", "ns"}) {
    const Unit unit = *MeantUnit(name, {"s"});
    const double seconds = unit.factor * time[0];
    if (seconds >= first && seconds < last && std::abs(step) * unit.factor <= longest) return unit;
  }
  return std::nullopt;
}

MendedClock MendClock(const Eigen::VectorXd& position, bool is_stamp, Eigen::VectorXd& time) {
  const Eigen::Index n = time.size();
  // a time of day begins again at midnight
  double midnight = 0;  // s
  for (Eigen::Index i = 1; is_stamp && i < n; ++i) {
    const double back = time[i] + midnight - time[i - 1];
    if (back < -kDay / 2 && back > -kDay) midnight += kDay;
    time[i] += midnight;
  }
  if (n < 2 || (time.tail(n - 1).array() > time.head(n - 1).array()).all()) return {};

  // samples that are no later than one before them
  Eigen::Index repeats = 0, late = 0;
  double latest = time[0];
  std::vector<bool> keep(static_cast<std::size_t>(n), true);
  for (Eigen::Index i = 1; i < n; ++i) {
    repeats += time[i] == time[i - 1];
    late += time[i] <= latest;
    keep[static_cast<std::size_t>(i)] = time[i] > latest;
    latest = std::max(latest, time[i]);
  }
  if (late <= n / kFewInAll) {
    return {std::move(keep),
            fmt::format("{} samples whose time is not after that of the sample before are left out",
                        late)};
  }

  // many that repeat, and none that steps back: ticks
  const std::vector<Eigen::Index> begin = TicksOf(time);
  const bool ticks = late == repeats && begin.size() > kFewestTicks && !AreSeveral(position, begin);
  return {{}, ticks ? SpreadTicks(begin, time) : ""};
}

}  // namespace warmjoint
