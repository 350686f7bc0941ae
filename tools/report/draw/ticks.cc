#include "tools/report/draw/ticks.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace warmjoint::report {
namespace {

constexpr const char* kMinus = "\u2212";

std::string WithTrueMinus(const std::string& text) {
  return text.starts_with('-') ? kMinus + text.substr(1) : text;
}

std::string Superscript(int value) {
  static constexpr const char* kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = value < 0 ? "⁻" : "";
  for (char digit : std::to_string(std::abs(value))) text += kDigits[digit - '0'];
  return text;
}

/// mantissa 10^exponent, the mantissa with `decimals` digits.
std::string WithPower(double mantissa, int decimals, int exponent) {
  const std::string digits = fmt::format("{:.{}f}", mantissa, decimals);
  if (digits == "1") return "10" + Superscript(exponent);
  return WithTrueMinus(digits) + "·10" + Superscript(exponent);
}

/// The power of ten of a number that is rounded to so many decimals of its mantissa.
int ExponentOf(double value, int decimals) {
  const std::string text = fmt::format("{:.{}e}", value, decimals);
  return std::stoi(text.substr(text.find('e') + 1));
}

std::string PowerText(double value, int decimals) {
  const int exponent = ExponentOf(value, decimals);
  return WithPower(value / std::pow(10, exponent), decimals, exponent);
}

bool NeedsPower(double value) {
  return value != 0 && (std::abs(value) < 0.99e-3 || std::abs(value) >= 0.99e5);
}

/// The smallest of 1, 2, 5 times a power of ten that cuts `span` into at most `wanted` pieces.
double RoundStep(double span, int wanted) {
  const double raw = span / std::max(wanted, 1);
  const double decade = std::pow(10, std::floor(std::log10(raw)));
  for (double factor : {1.0, 2.0, 5.0}) {
    if (factor * decade >= raw * (1 - 1e-9)) return factor * decade;
  }
  return 10 * decade;
}

std::vector<Tick> LinearTicks(const Axis& axis, int wanted) {
  // a round step, with no more decimals than it needs
  const double step = std::max(axis.finest, RoundStep(axis.upper - axis.lower, wanted));
  const double largest = std::max(std::abs(axis.lower), std::abs(axis.upper));
  const bool power = NeedsPower(largest);
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  // one power for the whole axis, and digits of the mantissa that tell neighbours apart
  const int exponent = static_cast<int>(std::floor(std::log10(largest) + 1e-9));
  const int digits = std::max(0, exponent - static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  std::vector<Tick> ticks;
  // rounding does not lose the ticks at the ends of the axis
  const double margin = 1e-6 * step;
  for (double i = std::ceil((axis.lower - margin) / step); i * step <= axis.upper + margin; ++i) {
    const double value = i * step;
    const std::string text =
        i == 0 ? "0"
               : (power ? WithPower(value / std::pow(10, exponent), digits, exponent)
                        : WithTrueMinus(fmt::format("{:.{}f}", value, decimals)));
    ticks.push_back({value, text});
  }
  return ticks;
}

std::vector<Tick> LogarithmicTicks(const Axis& axis, int wanted) {
  // few decades have room for ticks at 2 and 5, many for some of their powers only
  const double lower = std::log10(axis.lower);
  const double upper = std::log10(axis.upper);
  const double decades = upper - lower;
  std::vector<double> factors{1};
  if (3 * decades <= wanted) factors = {1, 2, 5};
  const int every = std::max(1, static_cast<int>(std::ceil(decades / std::max(wanted, 1))));

  std::vector<Tick> ticks;
  // ticks within the axis, with the decimals that small numbers need
  for (int exponent = static_cast<int>(std::floor(lower)); exponent <= upper; ++exponent) {
    if (exponent % every != 0) continue;
    for (double factor : factors) {
      const double value = factor * std::pow(10, exponent);
      if (value < axis.lower * (1 - 1e-9) || value > axis.upper * (1 + 1e-9)) continue;
      ticks.push_back({value, NumberText(value, std::max(0, -exponent))});
    }
  }
  return ticks;
}

}  // namespace

std::vector<Tick> AxisTicks(const Axis& axis, int wanted) {
  if (!axis.ticks.empty()) return axis.ticks;
  return axis.scale == Scale::linear ? LinearTicks(axis, wanted) : LogarithmicTicks(axis, wanted);
}

std::vector<double> MinorTicks(const Axis& axis) {
  std::vector<double> places;
  if (axis.scale == Scale::linear) return places;
  // at 2 to 9 times each power of ten
  const int first = static_cast<int>(std::floor(std::log10(axis.lower)));
  for (int exponent = first; std::pow(10, exponent) < axis.upper; ++exponent) {
    for (int factor = 2; factor <= 9; ++factor) {
      const double value = factor * std::pow(10, exponent);
      if (value >= axis.lower && value <= axis.upper) places.push_back(value);
    }
  }
  return places;
}

std::string NumberText(double value, int decimals) {
  if (!std::isfinite(value)) return "–";
  if (NeedsPower(value)) return PowerText(value, 0);
  return WithTrueMinus(fmt::format("{:.{}f}", value, decimals));
}

std::string SignificantText(double value, int digits) {
  if (!std::isfinite(value)) return "–";
  if (value == 0) return "0";
  if (NeedsPower(value)) return PowerText(value, digits - 1);
  const int exponent = ExponentOf(value, digits - 1);
  return WithTrueMinus(fmt::format("{:.{}f}", value, std::max(0, digits - 1 - exponent)));
}

std::string UnitText(std::string_view unit) {
  std::string text;
  for (size_t i = 0; i < unit.size(); ++i) {
    const bool square = unit.substr(i).starts_with("^2");
    text += square ? "²" : unit[i] == '.' ? "·" : std::string(1, unit[i]);
    if (square) ++i;
  }
  return text;
}

}  // namespace warmjoint::report
