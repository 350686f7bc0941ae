#include "tools/figures/symbols.h"

#include <fmt/core.h>
#include <warmjoint/friction.h>

#include <map>
#include <string_view>
#include <utility>

#include "identification/identifiers/identifier_list.h"
#include "models/friction/thermal.h"

namespace warmjoint::figures {

std::string SymbolOf(const std::string& parameter) {
  std::string symbol = parameter;
  // the symbol as the formulas have it
  for (const ParameterInfo& info : Thermal::parameters) {
    if (info.name == parameter) symbol = info.symbol;
  }
  for (const Law& law : Laws()) {
    for (const ParameterInfo& info : law.parameters) {
      if (info.name == parameter) symbol = info.symbol;
    }
  }
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
  std::size_t place = 0;
  for (const Law& law : Laws()) {
    for (const ParameterInfo& info : law.parameters) {
      if (info.name == parameter) return place;
      ++place;
    }
  }
  for (const ParameterInfo& info : Thermal::parameters) {
    if (info.name == parameter) return place;
    ++place;
  }
  return place;
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
