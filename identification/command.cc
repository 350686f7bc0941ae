#include "identification/command.h"

#include <fmt/format.h>
#include <warmjoint/friction.h>

#include <algorithm>

#include "models/friction/laws.h"

namespace warmjoint {

IdentifyCommand IdentifyCommand::With(std::string_view key, std::string_view value) const {
  IdentifyCommand more = *this;
  more.settings.emplace_back(key, value);
  return more;
}

bool IdentifyCommand::Sets(std::string_view key) const {
  return std::ranges::find(settings, key, &std::pair<std::string, std::string>::first) !=
         settings.end();
}

std::string IdentifyCommand::Text() const {
  std::string text = identifier;
  for (const auto& [key, value] : settings) {
    // options of the command line by themselves
    const bool is_own = key == "gravity" || key == "gear";
    text += is_own ? fmt::format(" --{} {}", key, value) : fmt::format(" --set {}={}", key, value);
  }
  return text;
}

std::string Remedy::Text() const {
  return command ? words + "try --identifier " + command->Text() : words;
}

bool HasLevelForEachDirection(std::string_view law) {
  return std::ranges::any_of(FindLaw(law)->parameters, [](const ParameterInfo& info) {
    return info.name == kCoulombNegativeRow.name;
  });
}

IdentifyCommand CurveCommand(std::string_view law, std::string_view warming) {
  IdentifyCommand command{"stribeck"};
  if (HasLevelForEachDirection(law)) command = command.With("law", AsymmetricStribeck::name);
  return warming == "none" ? command : command.With("warming", warming);
}

IdentifyCommand LinearCommand(std::string_view identifier, std::string_view law) {
  const IdentifyCommand command{std::string(identifier)};
  return HasLevelForEachDirection(law) ? command.With("law", Asymmetric::name) : command;
}

}  // namespace warmjoint
