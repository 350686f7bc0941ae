#include "identification/estimate.h"

namespace warmjoint::inline identification {

const EstimatedParameter* Estimate::Find(std::string_view name) const {
  for (const EstimatedParameter& parameter : parameters) {
    if (parameter.name == name) return &parameter;
  }
  return nullptr;
}

std::string Estimate::FullMessage() const {
  std::string full = message;
  for (const std::string& warning : warnings) full += (full.empty() ? "" : "; ") + warning;
  return full;
}

}  // namespace warmjoint::inline identification
