#include "models/recording/units.h"

#include <strings.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <ctime>
#include <numbers>
#include <utility>

#include "models/foundation/excerpt.h"

namespace warmjoint {
namespace {

using Texts = std::pair<std::string_view, std::string_view>;

/// Characters and words that stand for others, in the order in which they are replaced.
constexpr std::array kReplaced = std::to_array<Texts>({
    {" ", ""},
    {"°", "deg"},
    {"º", "deg"},
    {"µ", "u"},
    {"μ", "u"},
    {"·", "."},
    {"⋅", "."},
    {"*", "."},
    {"^", ""},
    {".s-1", "/s"},
    {"s-1", "/s"},
    {"min-1", "1/min"},
    {"-", "."},
    {"_per_", "/"},
});

/// Other spellings of units.
constexpr std::array kSpellings = std::to_array<Texts>({
    {"sec", "s"},         {"secs", "s"},         {"second", "s"},        {"seconds", "s"},
    {"msec", "ms"},       {"msecs", "ms"},       {"millis", "ms"},       {"milliseconds", "ms"},
    {"usec", "us"},       {"usecs", "us"},       {"micros", "us"},       {"microseconds", "us"},
    {"nsec", "ns"},       {"nsecs", "ns"},       {"nanosec", "ns"},      {"nanoseconds", "ns"},
    {"nanosecs", "ns"},   {"nanosecond", "ns"},  {"microsecs", "us"},    {"microsecond", "us"},
    {"minutes", "min"},   {"hours", "h"},        {"days", "d"},          {"radians", "rad"},
    {"radian", "rad"},    {"degree", "deg"},     {"degrees", "deg"},     {"turns", "turn"},
    {"rev", "turn"},      {"revs", "turn"},      {"rot", "turn"},        {"count", "counts"},
    {"rev/s", "turn/s"},  {"turns/s", "turn/s"}, {"rps", "turn/s"},      {"rad/sec", "rad/s"},
    {"deg/sec", "deg/s"}, {"dps", "deg/s"},      {"degrees/s", "deg/s"}, {"1/min", "rpm"},
    {"/min", "rpm"},      {"U/min", "rpm"},      {"r/min", "rpm"},       {"rev/min", "rpm"},
    {"turn/min", "rpm"},  {"turns/min", "rpm"},  {"Nm", "N.m"},          {"mNm", "mN.m"},
    {"cNm", "cN.m"},      {"kNm", "kN.m"},       {"Nmm", "N.mm"},        {"kg.cm", "kgf.cm"},
    {"kgcm", "kgf.cm"},   {"oz.in", "ozf.in"},   {"ozin", "ozf.in"},     {"lb.in", "lbf.in"},
    {"in.lb", "lbf.in"},  {"in.lbf", "lbf.in"},  {"lb.ft", "lbf.ft"},    {"ft.lb", "lbf.ft"},
    {"ft.lbf", "lbf.ft"}, {"amp", "A"},          {"amps", "A"},          {"ampere", "A"},
    {"volt", "V"},        {"volts", "V"},        {"percent", "%"},       {"C", "degC"},
    {"F", "degF"},        {"celsius", "degC"},
});

constexpr std::string_view kOfMotion = "m/s rad/s";  // these, and what they begin with
constexpr std::size_t kLongest = 24;                 // bytes of any unit in brackets

/// The text in the characters of Units, without brackets around it.
std::string Plain(std::string_view text) {
  constexpr std::string_view open = "([{<", close = ")]}>";
  text = Trimmed(text);
  const bool bracketed = text.size() > 2 && open.find(text.front()) != std::string_view::npos &&
                         open.find(text.front()) == close.find(text.back());
  if (bracketed) text = text.substr(1, text.size() - 2);
  std::string plain(text);
  for (const auto& [from, to] : kReplaced) {
    for (std::size_t at = 0; (at = plain.find(from, at)) != std::string::npos; at += to.size()) {
      plain.replace(at, from.size(), to);
    }
  }
  return plain;
}

/// Whether two texts are alike, letters of either case being one. A capital M before a capital is mega, no milli. Of single letters a
/// capital may be meant for a small one, as in TIME_S.
bool AreAlike(std::string_view a, std::string_view b) {
  const bool is_mega = a.size() > 1 && b.size() > 1 && a[0] != b[0] && std::isupper(b[1]);
  const bool may_differ = a.size() > 1 || (b.size() == 1 && std::islower(b[0]));
  return may_differ && !is_mega && EqualIgnoringCase(a, b);
}

/// Dates and times, as strptime reads them; a fraction of a second and a zone may follow.
constexpr const char* kStamps[]{"%Y-%m-%dT%H:%M:%S", "%Y-%m-%d %H:%M:%S", "%Y/%m/%d %H:%M:%S",
                                "%d.%m.%Y %H:%M:%S", "%Y%m%dT%H%M%S",     "%Y-%m-%d_%H:%M:%S",
                                "%Y-%m-%d",          "%d.%m.%Y",          "%H:%M:%S"};

constexpr int kFirstYear = 0;  // since 1900; why: a year of two digits may be a day or a month

/// The text behind what `format` reads of a stamp; nullptr where it does not, and where the year has two digits.
const char* Behind(const char* text, const char* format, std::tm* time) {
  *time = {};
  time->tm_year = 70;
  time->tm_mday = 1;
  const char* const behind = strptime(text, format, time);
  return time->tm_year < kFirstYear ? nullptr : behind;
}

}  // namespace

const std::vector<Unit>& Units() {
  constexpr double turn = 2 * std::numbers::pi;             // rad
  constexpr double inch = 0.0254, pound = 4.4482216152605;  // m, N
  constexpr double kilogram = 9.80665;                      // N
  static const std::vector<Unit> units{
      // time
      {"s", "s"},
      {"ms", "s", 1e-3},
      {"us", "s", 1e-6},
      {"ns", "s", 1e-9},
      {"min", "s", 60},
      {"h", "s", 3600},
      {"d", "s", 86400},
      // angle and length; counts are multiplied by --scale
      {"rad", "rad"},
      {"mrad", "rad", 1e-3},
      {"deg", "rad", turn / 360},
      {"turn", "rad", turn},
      {"counts", "rad"},
      {"m", "m"},
      {"cm", "m", 1e-2},
      {"mm", "m", 1e-3},
      {"um", "m", 1e-6},
      {"counts", "m"},
      // speed
      {"rad/s", "rad/s"},
      {"mrad/s", "rad/s", 1e-3},
      {"deg/s", "rad/s", turn / 360},
      {"turn/s", "rad/s", turn},
      {"rpm", "rad/s", turn / 60},
      {"counts/s", "rad/s"},
      {"m/s", "m/s"},
      {"mm/s", "m/s", 1e-3},
      {"m/min", "m/s", 1.0 / 60},
      {"counts/s", "m/s"},
      // torque and force
      {"N.m", "N.m"},
      {"mN.m", "N.m", 1e-3},
      {"cN.m", "N.m", 1e-2},
      {"kN.m", "N.m", 1e3},
      {"N.mm", "N.m", 1e-3},
      {"kgf.cm", "N.m", 1e-2 * kilogram},
      {"ozf.in", "N.m", pound / 16 * inch},
      {"lbf.in", "N.m", pound * inch},
      {"lbf.ft", "N.m", 12 * pound * inch},
      {"N", "N"},
      {"mN", "N", 1e-3},
      {"kN", "N", 1e3},
      // what stands for torque where no torque is logged
      {"A", "A"},
      {"mA", "A", 1e-3},
      {"V", "V"},
      {"mV", "V", 1e-3},
      {"%", "%"},
      {"raw", "raw"},
      // temperature
      {"degC", "degC"},
      {"K", "degC", 1, -273.15},
      {"degF", "degC", 5.0 / 9, -160.0 / 9},
  };
  return units;
}

std::optional<Unit> MeantUnit(std::string_view text, const std::vector<std::string>& bases) {
  if (text.size() > kLongest) return std::nullopt;
  const std::string plain = Plain(text);
  const auto fits = [&](const Unit& unit) {
    return bases.empty() || std::ranges::find(bases, unit.base) != bases.end();
  };
  // as it is written before as it may be meant
  const auto are_same = [](std::string_view a, std::string_view b) { return a == b; };
  for (const auto are_alike : {+are_same, &AreAlike}) {
    std::string_view name = plain;
    for (const auto& [spelling, meant] : kSpellings) {
      if (are_alike(plain, spelling)) name = meant;
    }
    for (const Unit& unit : Units()) {
      if (fits(unit) && (name == unit.name || are_alike(name, unit.name))) return unit;
    }
  }
  return std::nullopt;
}

Unit FindUnit(std::string_view name, const std::vector<std::string>& bases, std::string_view column,
              const Place& place) {
  if (const std::optional<Unit> unit = MeantUnit(name, bases)) return *unit;
  // another spelling may be another size: all that fit are listed, and none is suggested
  std::vector<std::string> fitting;
  for (const Unit& unit : Units()) {
    if (std::ranges::find(bases, unit.base) != bases.end()) fitting.emplace_back(unit.name);
  }
  Refuse(place,
         "{} cannot be in '{}', but in {}; --unit gives its unit, and --joint linear allows "
         "lengths and "
         "forces",
         column, Excerpt(name), ExcerptOfList(fitting));
}

NameAndUnit SplitUnit(std::string_view name, const std::vector<std::string>& bases) {
  // what stands in brackets at the end
  name = name.substr(0, name.find_last_not_of(" \t") + 1);
  const char close = name.empty() ? ' ' : name.back();
  const std::size_t open = close == ')' ? name.rfind('(') : close == ']' ? name.rfind('[') : 0;
  if (open > 0 && open != std::string_view::npos) {
    const std::string_view stem = name.substr(0, open);
    const std::optional<Unit> unit = MeantUnit(name.substr(open), bases);
    if (!unit) return {std::string(name)};
    return {std::string(stem.substr(0, stem.find_last_not_of(" _") + 1)), unit, true};
  }
  // what stands behind a separator, the longest first: rad_s before s
  for (std::size_t at = 0; (at = name.find_first_of("_ /.,-", at)) != std::string_view::npos;
       ++at) {
    const std::string_view behind = name.substr(at + 1);
    if (behind.size() > kLongest) continue;
    for (const char stroke : {'_', '/', '.'}) {
      std::string text(behind);
      std::ranges::replace(text, '_', stroke);
      const std::optional<Unit> unit = MeantUnit(text, bases);
      // a unit of motion can be nothing else
      const bool is_sure =
          unit && unit->name.size() > 1 && kOfMotion.find(unit->base) != std::string_view::npos;
      if (at > 0 && unit) return {std::string(name.substr(0, at)), unit, is_sure};
    }
  }
  return {std::string(name)};
}

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

}  // namespace warmjoint
