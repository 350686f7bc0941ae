#include "tools/actions/fit_again.h"

#include <algorithm>

#include "identification/answer/identify.h"
#include "identification/identifiers/identifier_list.h"

namespace warmjoint::inline tools {
namespace {

/// The fit before any verdict; nothing where the identifier is none of ours.
std::optional<Estimate> FitBehind(const Estimate& estimate, const PreparedLog& log) {
  const auto& all = Identifiers();
  const auto found = std::ranges::find(all, estimate.identifier, &Identifier::name);
  if (found == all.end()) return std::nullopt;
  const Options options(found->options, estimate.options, {"options of the estimate"});
  return IdentifyUnjudged(*found, {log, options, {}});
}

}  // namespace

Estimate WithFitAgain(Estimate estimate, const PreparedLog& log) {
  if (estimate.friction) return estimate;
  std::optional<Estimate> fit = FitBehind(estimate, log);
  if (!fit) return estimate;
  estimate.parameters = std::move(fit->parameters);
  estimate.friction = std::move(fit->friction);
  estimate.gravity = std::move(fit->gravity);
  estimate.bands = std::move(fit->bands);
  return estimate;
}

std::optional<Estimate> FitOnFirst(const Estimate& estimate, const PreparedLog& log, double share) {
  const Eigen::VectorXd& time = log.taken().measurements.time;
  const double end = time[0] + share * (time.tail(1)[0] - time[0]);
  std::optional<Estimate> fit = FitBehind(estimate, log.Before(end));
  if (!fit || !fit->friction) return std::nullopt;
  fit->status = estimate.status;
  return fit;
}

}  // namespace warmjoint::inline tools
