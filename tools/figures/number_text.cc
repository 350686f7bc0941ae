#include "tools/figures/number_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace warmjoint::figures {
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

}  // namespace

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

}  // namespace warmjoint::figures
