#include "identification/estimate.h"

namespace warmjoint::inline identification {

std::string_view StatusName(Status status) {
  switch (status) {
    case Status::ok:
      return "ok";
    case Status::not_converged:
      return "not_converged";
    case Status::not_identifiable:
      return "not_identifiable";
    case Status::inadequate_model:
      return "inadequate_model";
    case Status::bad_data:
      break;
  }
  return "bad_data";
}

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
