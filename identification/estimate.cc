#include "identification/estimate.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "models/foundation/serialize.h"
#include "models/friction/friction_json.h"

namespace warmjoint::inline identification {

const EstimatedParameter* Estimate::Find(std::string_view name) const {
  const auto found = std::ranges::find(parameters, name, &EstimatedParameter::name);
  return found == parameters.end() ? nullptr : &*found;
}

std::string Estimate::FullMessage() const {
  std::string full = message;
  for (const std::string& warning : warnings) full += (full.empty() ? "" : "; ") + warning;
  return full;
}

void Estimate::TakeMessage(const std::string& full) {
  message = full;
  // the last warning first, each with its separator; others may warn without repeating themselves
  for (auto warning = warnings.rbegin(); warning != warnings.rend(); ++warning) {
    if (!message.ends_with(*warning)) return;
    message.resize(message.size() - warning->size());
    if (message.ends_with("; ")) message.resize(message.size() - 2);
  }
}

Tree EstimateToTree(const Estimate& estimate) { return WriteFields(estimate); }

Estimate EstimateFrom(const Node& node) {
  return ReadAs<Estimate>(node.With(UnknownKeys::ignored));
}

}  // namespace warmjoint::inline identification
