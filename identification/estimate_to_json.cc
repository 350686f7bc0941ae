#include "identification/estimate_to_json.h"

#include <nlohmann/json.hpp>

#include "identification/gravity_json.h"
#include "identification/map_band_json.h"
#include "models/foundation/matrix_json.h"
#include "models/foundation/number_json.h"
#include "models/friction/friction_json.h"

namespace warmjoint::inline identification {
namespace {

using nlohmann::json;

// what is absent or not a finite number becomes null

json ParameterToJson(const EstimatedParameter& parameter) {
  json result{{"value", NumberOrNull(parameter.value)},
              {"unit", parameter.unit},
              {"std", nullptr},
              {"interval95", nullptr}};
  // not every parameter has errors
  if (parameter.std) result["std"] = NumberOrNull(*parameter.std);
  if (parameter.interval95) {
    const auto& [lower, upper] = *parameter.interval95;
    result["interval95"] = {NumberOrNull(lower), NumberOrNull(upper)};
  }
  return result;
}

json MetricsToJson(const std::optional<Metrics>& metrics) {
  if (!metrics) return nullptr;
  return {{"n", metrics->n},
          {"parameters", metrics->parameters},
          {"effective_parameters", NumberOrNull(metrics->effective_parameters)},
          {"rmse", NumberOrNull(metrics->rmse)},
          {"mae", NumberOrNull(metrics->mae)},
          {"fit", NumberOrNull(metrics->fit)},
          {"fpe", NumberOrNull(metrics->fpe)}};
}

json TraceToJson(const std::vector<TraceEntry>& trace) {
  json result = json::array();
  for (const TraceEntry& entry : trace) {
    json parameters = json::object();
    for (const auto& [name, value] : entry.parameters) parameters[name] = NumberOrNull(value);
    result.push_back({{"iteration", entry.iteration},
                      {"rmse", NumberOrNull(entry.rmse)},
                      {"parameters", parameters}});
  }
  return result;
}

json CovarianceToJson(const std::optional<ParameterCovariance>& covariance) {
  if (!covariance) return nullptr;
  return {{"parameters", covariance->parameters}, {"matrix", MatrixToJson(covariance->matrix)}};
}

json MovesToJson(const ParameterMoves& moves) {
  json result = json::object();
  for (const auto& [name, move] : moves) result[name] = NumberOrNull(move);
  return result;
}

/// Figures of a test that was not made are null.
json DiagnosticToJson(const Diagnostic& one) {
  // every member stands there, null until it is known
  json result{{"test", one.test}, {"made", one.made}, {"reason", nullptr}};
  for (const char* key : {"statistic", "p", "p_adjusted", "rejected", "effect", "moves"}) {
    result[key] = nullptr;
  }
  if (!one.reason.empty()) result["reason"] = one.reason;
  // figures only of a test that was made
  if (!one.made) return result;
  result["statistic"] = NumberOrNull(one.statistic);
  result["p"] = NumberOrNull(one.p);
  result["p_adjusted"] = NumberOrNull(one.p_adjusted);
  result["rejected"] = one.rejected;
  result["effect"] = {{"value", NumberOrNull(one.effect)}, {"unit", one.effect_unit}};
  result["moves"] = MovesToJson(one.moves);
  return result;
}

json ChoiceToJson(const StructureChoice& choice) {
  // the structures that were tried, whether they fitted or not
  json trials = json::array();
  for (const StructureTrial& one : choice.trials) {
    trials.push_back({{"name", one.name},
                      {"rmse", one.rmse ? NumberOrNull(*one.rmse) : json(nullptr)},
                      {"parameters", NumberOrNull(one.parameters)},
                      {"dropped", one.dropped.empty() ? json(nullptr) : json(one.dropped)}});
  }
  return {{"chosen", choice.chosen},
          {"reason", choice.reason},
          {"blocks", choice.blocks},
          {"trials", trials}};
}

}  // namespace

json EstimateToJson(const Estimate& estimate) {
  // what every estimate has, null where nothing is known
  json parameters = json::object();
  for (const EstimatedParameter& parameter : estimate.parameters) {
    parameters[parameter.name] = ParameterToJson(parameter);
  }
  json result{{"identifier", estimate.identifier},
              {"status", StatusName(estimate.status)},
              {"message", estimate.FullMessage()},
              {"parameters", parameters},
              {"metrics", MetricsToJson(estimate.metrics)},
              {"holdout", MetricsToJson(estimate.holdout)},
              {"trace", TraceToJson(estimate.trace)},
              {"friction", estimate.friction ? FrictionToJson(*estimate.friction) : json(nullptr)},
              {"gravity", estimate.gravity ? GravityToJson(*estimate.gravity) : json(nullptr)},
              {"covariance", CovarianceToJson(estimate.covariance)}};

  // what only some have
  if (!estimate.options.empty()) result["options"] = estimate.options;
  if (!estimate.warnings.empty()) result["warnings"] = estimate.warnings;
  for (const MapBand& band : estimate.bands) result["bands"].push_back(BandToJson(band));
  for (const FrictionAtSpeed& one : estimate.at_speeds) {
    json row{{"speed", one.speed},
             {"value", one.value},
             {"std", one.std},
             {"interval95", one.interval95}};
    if (!one.speed_unit.empty()) row["speed_unit"] = one.speed_unit;
    if (!one.unit.empty()) row["unit"] = one.unit;
    result["friction_at_speeds"].push_back(std::move(row));
  }
  // tests, and what was taken for granted
  for (const Diagnostic& one : estimate.diagnostics) {
    result["diagnostics"].push_back(DiagnosticToJson(one));
  }
  for (const Assumption& one : estimate.assumptions) {
    result["assumptions"].push_back(
        {{"name", one.name}, {"meaning", one.meaning}, {"moves", MovesToJson(one.moves)}});
  }
  // where the log leaves the joint
  for (const EstimatedParameter& one : estimate.state_end) {
    result["state_end"][one.name] = ParameterToJson(one);
  }
  if (!estimate.without_holdout.empty()) result["without_holdout"] = estimate.without_holdout;
  if (estimate.choice) result["choice"] = ChoiceToJson(*estimate.choice);
  return result;
}

}  // namespace warmjoint::inline identification
