#include "tools/interface/convert_estimate.h"

#include <array>

#include "models/foundation/bad_input.h"
#include "models/foundation/serialize.h"
#include "tools/interface/convert_friction.h"
#include "tools/interface/convert_numbers.h"

namespace warmjoint::api {
namespace {

/// Each status of the interface beside the same of the rooms.
constexpr std::array kStatuses{
    std::pair{Status::ok, identification::Status::ok},
    std::pair{Status::not_converged, identification::Status::not_converged},
    std::pair{Status::not_identifiable, identification::Status::not_identifiable},
    std::pair{Status::inadequate_model, identification::Status::inadequate_model},
    std::pair{Status::bad_data, identification::Status::bad_data}};

Status FromStatus(identification::Status status) {
  for (const auto& [ours, theirs] : kStatuses) {
    if (theirs == status) return ours;
  }
  return Status::bad_data;
}

identification::Status ToStatus(Status status) {
  for (const auto& [ours, theirs] : kStatuses) {
    if (ours == status) return theirs;
  }
  return identification::Status::bad_data;
}

identification::GravityKind GravityKindOf(const std::string& name) {
  return models::ChoiceOf<identification::GravityKind>(
      models::Node({{"kind", name}}, "gravity").Require("kind", ""));
}

std::optional<identification::Metrics> ToMetrics(const std::optional<Metrics>& metrics) {
  if (!metrics) return std::nullopt;
  return identification::Metrics{metrics->n,    metrics->parameters, metrics->effective_parameters,
                                 metrics->rmse, metrics->mae,        metrics->fit,
                                 metrics->fpe};
}

std::optional<models::ParameterCovariance> ToCovariance(
    const std::optional<Covariance>& covariance) {
  if (!covariance) return std::nullopt;
  // a square matrix with a row and a column for each parameter
  const std::size_t p = covariance->parameters.size();
  const auto size = static_cast<Eigen::Index>(p);
  models::ParameterCovariance made{covariance->parameters, Eigen::MatrixXd(size, size)};
  if (covariance->matrix.size() != p) {
    models::Refuse({"covariance"}, "has {} parameters and {} rows; give a row for each", p,
                   covariance->matrix.size());
  }
  for (std::size_t i = 0; i < p; ++i) {
    if (covariance->matrix[i].size() != p) {
      models::Refuse({"covariance"}, "has {} numbers in row {}; give {}",
                     covariance->matrix[i].size(), i + 1, p);
    }
    made.matrix.row(static_cast<Eigen::Index>(i)) = ToEigen(covariance->matrix[i]).transpose();
  }
  return made;
}

std::optional<Covariance> FromCovariance(
    const std::optional<models::ParameterCovariance>& covariance) {
  if (!covariance) return std::nullopt;
  Covariance made{covariance->parameters, {}};
  for (const auto& row : covariance->matrix.rowwise()) {
    made.matrix.emplace_back(row.begin(), row.end());
  }
  return made;
}

/// Parameters of one interface as those of the other.
template <typename To, typename From>
std::vector<To> Parameters(const std::vector<From>& given) {
  std::vector<To> made;
  for (const From& one : given) {
    made.push_back({one.name, one.value, one.unit, one.std, one.interval95});
  }
  return made;
}

/// The same of how a structure was chosen.
template <typename To, typename From>
To Choice(const From& choice) {
  To made{choice.chosen, choice.reason, choice.blocks, {}};
  for (const auto& one : choice.trials) {
    made.trials.push_back({one.name, one.rmse, one.parameters, one.dropped});
  }
  return made;
}

}  // namespace

Metrics FromMetrics(const identification::Metrics& metrics) {
  return {metrics.n,   metrics.parameters, metrics.effective_parameters, metrics.rmse, metrics.mae,
          metrics.fit, metrics.fpe};
}

identification::Estimate ToEstimate(const Estimate& estimate) {
  // what was asked, and how it went
  identification::Estimate made;
  made.identifier = estimate.identifier;
  made.options = estimate.options;
  made.status = ToStatus(estimate.status);
  made.message = estimate.message;
  made.warnings = estimate.warnings;

  // numbers, and how well they fit
  made.parameters = Parameters<identification::EstimatedParameter>(estimate.parameters);
  made.metrics = ToMetrics(estimate.metrics);
  made.holdout = ToMetrics(estimate.holdout);
  for (const TraceEntry& entry : estimate.trace) {
    made.trace.push_back({entry.iteration, entry.parameters, entry.rmse});
  }
  made.covariance = ToCovariance(estimate.covariance);

  // the model: friction, gravity, and what law and maps are together
  if (estimate.friction) made.friction = ToDescription(*estimate.friction);
  if (estimate.gravity) {
    made.gravity = {GravityKindOf(estimate.gravity->kind), estimate.gravity->knots,
                    ToEigen(estimate.gravity->values)};
  }
  for (const MapBand& band : estimate.bands) {
    made.bands.push_back({band.quantities, band.points, band.value, band.std, band.interval95});
  }
  for (const FrictionAtSpeed& one : estimate.friction_at_speeds) {
    made.at_speeds.push_back(
        {one.speed, one.value, one.std, one.interval95, one.speed_unit, one.unit});
  }

  // the verdict: tests for lack of fit, and what none of them can see
  for (const Diagnostic& one : estimate.diagnostics) {
    made.diagnostics.push_back({one.test, one.made, one.reason, one.statistic, one.p,
                                one.p_adjusted, one.rejected, one.effect, one.effect_unit,
                                one.moves});
  }
  for (const Assumption& one : estimate.assumptions) {
    made.assumptions.push_back({one.name, one.meaning, one.moves});
  }

  // the state at the end, and the choice of a structure
  made.state_end = Parameters<identification::EstimatedParameter>(estimate.state_end);
  made.without_holdout = estimate.without_holdout;
  if (estimate.choice) made.choice = Choice<identification::StructureChoice>(*estimate.choice);
  return made;
}

Estimate FromEstimate(const identification::Estimate& estimate) {
  // what was asked, and how it went
  Estimate made;
  made.identifier = estimate.identifier;
  made.options = estimate.options;
  made.status = FromStatus(estimate.status);
  made.message = estimate.message;
  made.warnings = estimate.warnings;

  // numbers, and how well they fit
  made.parameters = Parameters<Parameter>(estimate.parameters);
  if (estimate.metrics) made.metrics = FromMetrics(*estimate.metrics);
  if (estimate.holdout) made.holdout = FromMetrics(*estimate.holdout);
  for (const identification::TraceEntry& entry : estimate.trace) {
    made.trace.push_back({entry.iteration, entry.parameters, entry.rmse});
  }
  made.covariance = FromCovariance(estimate.covariance);

  // the model: friction, gravity, and what law and maps are together
  if (estimate.friction) made.friction = FromDescription(*estimate.friction);
  if (estimate.gravity) {
    made.gravity = {std::string(models::NameOf(estimate.gravity->kind)), estimate.gravity->knots,
                    FromEigen(estimate.gravity->values)};
  }
  for (const identification::MapBand& band : estimate.bands) {
    made.bands.push_back({band.quantities, band.points, band.value, band.std, band.interval95});
  }
  for (const identification::FrictionAtSpeed& one : estimate.at_speeds) {
    made.friction_at_speeds.push_back(
        {one.speed, one.value, one.std, one.interval95, one.speed_unit, one.unit});
  }

  // the verdict: tests for lack of fit, and what none of them can see
  for (const identification::Diagnostic& one : estimate.diagnostics) {
    made.diagnostics.push_back({one.test, one.made, one.reason, one.statistic, one.p,
                                one.p_adjusted, one.rejected, one.effect, one.effect_unit,
                                one.moves});
  }
  for (const identification::Assumption& one : estimate.assumptions) {
    made.assumptions.push_back({one.name, one.meaning, one.moves});
  }

  // the state at the end, and the choice of a structure
  made.state_end = Parameters<Parameter>(estimate.state_end);
  made.without_holdout = estimate.without_holdout;
  if (estimate.choice) made.choice = Choice<StructureChoice>(*estimate.choice);
  return made;
}

tools::CarriedHeat ToCarried(const CarriedHeat& carried) {
  return {carried.file, carried.pause,  carried.pause_from,
          carried.unit, carried.energy, carried.std};
}

CarriedHeat FromCarried(const tools::CarriedHeat& carried) {
  return {carried.file, carried.pause,  carried.pause_from,
          carried.unit, carried.energy, carried.std};
}

}  // namespace warmjoint::api
