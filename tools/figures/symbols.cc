#include "tools/figures/symbols.h"

#include <fmt/core.h>
#include <warmjoint/friction.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "identification/identifiers/identifier_list.h"
#include "models/friction/thermal.h"

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

/// The power of ten of a number that is rounded to so many decimals of its mantissa.
int ExponentOf(double value, int decimals) {
  const std::string text = fmt::format("{:.{}e}", value, decimals);
  return std::stoi(text.substr(text.find('e') + 1));
}

/// mantissa 10^exponent, the mantissa with `decimals` digits.
std::string PowerText(double value, int decimals) {
  const int exponent = ExponentOf(value, decimals);
  const std::string digits = fmt::format("{:.{}f}", value / std::pow(10, exponent), decimals);
  if (digits == "1") return "10" + Superscript(exponent);
  return WithTrueMinus(digits) + "·10" + Superscript(exponent);
}

/// The parameters of all laws, law by law, then those of warming.
const std::vector<ParameterInfo>& AllParameters() {
  static const std::vector<ParameterInfo> all = [] {
    std::vector<ParameterInfo> listed;
    for (const Law& law : Laws()) {
      listed.insert(listed.end(), law.parameters.begin(), law.parameters.end());
    }
    listed.insert(listed.end(), Thermal::parameters.begin(), Thermal::parameters.end());
    return listed;
  }();
  return all;
}

}  // namespace

std::string SignificantText(double value, int digits) {
  if (!std::isfinite(value)) return "–";
  if (value == 0) return "0";
  const double size = std::abs(value);
  if (size < 0.99e-3 || size >= 0.99e5) return PowerText(value, digits - 1);
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

std::string SymbolOf(const std::string& parameter) {
  // the symbol as the formulas have it
  const std::vector<ParameterInfo>& all = AllParameters();
  const auto known = std::ranges::find(all, parameter, &ParameterInfo::name);
  const std::string symbol(known == all.end() ? parameter : known->symbol);
  // in print with Greek letters and indices
  static const std::map<std::string, std::string> kInPrint{
      {"tau", "τ"},
      {"kv", "k_{v}"},
      {"kc", "k_{c}"},
      {"kc+", "k_{c+}"},
      {"kc-", "k_{c−}"},
      {"ks", "k_{s}"},
      {"vs", "v_{s}"},
      {"sigma0", "σ_{0}"},
      {"sigma1", "σ_{1}"},
      {"sigma2", "σ_{2}"},
      {std::string(kDiscreteGainName), "k_{e}"},
      {std::string(kPoleName), "t_{e}"}};
  const auto found = kInPrint.find(symbol);
  return found == kInPrint.end() ? symbol : found->second;
}

std::size_t PlaceInLaws(const std::string& parameter) {
  const std::vector<ParameterInfo>& all = AllParameters();
  const auto known = std::ranges::find(all, parameter, &ParameterInfo::name);
  return static_cast<std::size_t>(known - all.begin());
}

std::string NameWithSymbol(const std::string& parameter) {
  const std::string symbol = SymbolOf(parameter);
  return symbol == parameter ? parameter : fmt::format("{}, {}", parameter, symbol);
}

Hue IdentifierHue(const std::string& of) {
  const std::string identifier = CurrentName(of);
  // identifiers of this project have colours of their own
  static constexpr std::pair<std::string_view, Hue> kKnown[] = {
      {"nominal-ls", Hue::grey},      {"energy-als", Hue::vermilion},
      {"energy-ml", Hue::blue},       {"rls", Hue::green},
      {"motor-ridge", Hue::purple},   {"kalman", Hue::sky},
      {"position-ridge", Hue::orange}};
  for (const auto& [name, hue] : kKnown) {
    if (name == identifier) return hue;
  }
  // any other has one by its letters, the same in every picture
  static constexpr Hue kOthers[] = {Hue::green, Hue::purple, Hue::orange, Hue::sky};
  std::size_t sum = 0;
  for (char letter : identifier) sum += static_cast<unsigned char>(letter);
  return kOthers[sum % std::size(kOthers)];
}

}  // namespace warmjoint::figures
