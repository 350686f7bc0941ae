#include "tools/figures/shown_parameters.h"

#include <fmt/format.h>
#include <warmjoint/friction.h>

#include <algorithm>
#include <cmath>

namespace warmjoint {
namespace {

/// Whether only the prior of a map tells this parameter.
bool IsShared(const Estimate& estimate, const EstimatedParameter& one) {
  if (estimate.friction_at_speeds.empty() || one.interval95) return false;
  const Law* law = estimate.friction ? FindLaw(estimate.friction->law) : nullptr;
  return law && std::ranges::any_of(law->parameters, [&](const ParameterInfo& info) {
           return info.name == one.name;
         });
}

/// Friction at each of the speeds.
std::vector<EstimatedParameter> AtSpeeds(const Estimate& estimate) {
  std::vector<EstimatedParameter> rows;
  for (const FrictionAtSpeed& one : estimate.friction_at_speeds) {
    std::string name = fmt::format("friction {} at {:.3g}",
                                   one.speed < 0 ? "backwards" : "forwards", std::abs(one.speed));
    if (!one.speed_unit.empty()) name += " " + one.speed_unit;
    rows.push_back({std::move(name), one.value, one.unit, one.std, one.interval95});
  }
  return rows;
}

}  // namespace

std::vector<EstimatedParameter> ShownParameters(const Estimate& estimate) {
  std::vector<EstimatedParameter> shown;
  for (const EstimatedParameter& one : estimate.parameters) {
    if (!IsShared(estimate, one)) shown.push_back(one);
  }
  const std::vector<EstimatedParameter> speeds = AtSpeeds(estimate);
  shown.insert(shown.end(), speeds.begin(), speeds.end());
  return shown;
}

}  // namespace warmjoint
