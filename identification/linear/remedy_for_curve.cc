#include "identification/linear/remedy_for_curve.h"

#include <fmt/format.h>
#include <warmjoint/friction.h>

#include <algorithm>

#include "models/friction/asymmetric.h"
#include "models/friction/asymmetric_stribeck.h"

namespace warmjoint {

bool TellsDirections(std::string_view law) {
  return std::ranges::any_of(FindLaw(law)->parameters, [](const ParameterInfo& info) {
    return info.name == kCoulombNegativeRow.name;
  });
}

std::string CurveCommand(std::string_view law, std::string_view warming) {
  std::string command = "stribeck";
  if (TellsDirections(law)) command += fmt::format(" --set law={}", AsymmetricStribeck::name);
  if (warming != "none") command += fmt::format(" --set warming={}", warming);
  return command;
}

std::string LinearCommand(std::string_view identifier, std::string_view law) {
  std::string command(identifier);
  if (TellsDirections(law)) command += fmt::format(" --set law={}", Asymmetric::name);
  return command;
}

}  // namespace warmjoint
