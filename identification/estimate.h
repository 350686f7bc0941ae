// What an identifier answers.
#pragma once

#include <Eigen/Core>
#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "identification/diagnostic.h"
#include "identification/friction_at_speed.h"
#include "identification/gravity.h"
#include "identification/map_band.h"
#include "models/friction/friction_description.h"

namespace warmjoint::inline identification {

/// Whether the numbers can be trusted, and if not, why.
enum class Status { ok, not_converged, not_identifiable, inadequate_model, bad_data };

/// "ok", "not_converged", ...
std::string_view StatusName(Status status);

struct EstimatedParameter {
  std::string name;
  double value = 0;
  std::string unit;
  std::optional<double> std;  // standard deviation
  std::optional<std::array<double, 2>> interval95;
};

/// Agreement of a fit with the samples that it kept. y: measured, yhat: fitted, e = y - yhat.
struct Metrics {
  int n = 0;                        // samples
  int parameters = 0;               // d
  double effective_parameters = 0;  // trace of the hat matrix; d where nothing is penalised
  double rmse = 0;                  // sqrt(mean(e^2)), N.m or N
  double mae = 0;                   // mean(|e|), N.m or N
  double fit = 0;                   // 100 (1 - |e| / |y - mean(y)|), %
  double fpe = 0;                   // V (1 + d/n)/(1 - d/n), V = mean(e^2)
};

/// Metrics of a fit. measured, fitted: [n] N.m or N.
Metrics ComputeMetrics(const Eigen::VectorXd& measured, const Eigen::VectorXd& fitted,
                       int parameters, double effective_parameters);

/// State of an iterative identifier after one iteration.
struct TraceEntry {
  int iteration = 0;
  std::vector<std::pair<std::string, double>> parameters;
  double rmse = 0;  // over the kept samples, N.m or N
};

/// A structure that was tried.
struct StructureTrial {
  std::string name;            // identifier and options: "energy-ml law=coulomb"
  std::optional<double> rmse;  // on held-out blocks, N.m or N; none where it was dropped before
  double parameters = 0;       // effective number; 0 where nothing was fitted
  std::string dropped;         // why it was no contender; empty for one that was
};

/// Which of several structures was chosen, and why.
struct StructureChoice {
  std::string chosen;
  std::string reason;  // one clause
  int blocks = 0;      // of time that were held out in turn
  std::vector<StructureTrial> trials;
};

/// Covariance of some of an estimate's values.
struct ParameterCovariance {
  std::vector<std::string> parameters;  // [p] names
  Eigen::MatrixXd matrix;               // [p x p] in products of their units
};

struct Estimate {
  std::string identifier;
  std::map<std::string, std::string> options;  // of the identifier, those not at their defaults
  Status status = Status::ok;
  std::string message;  // one sentence; for a failure: what is wrong and what would help
  /// What must be known before numbers that pass are used, each a clause: "the kernels can imitate
  /// coulomb, ...". Empty where nothing passes.
  std::vector<std::string> warnings;
  std::vector<EstimatedParameter> parameters;  // empty where nothing trustworthy is known
  std::optional<Metrics> metrics;
  std::optional<Metrics> holdout;
  std::string without_holdout;  // why there is none: a clause; empty: there is, or none was tried
  std::vector<TraceEntry> trace;
  std::optional<FrictionDescription> friction;
  std::optional<GravityModel> gravity;  // what the fit took for gravity beside friction
  std::vector<MapBand> bands;           // one for each of the friction's maps
  /// Beside maps, in place of parameters of the law that only the prior tells: friction at the lowest,
  /// the median and the highest speed.
  std::vector<FrictionAtSpeed> at_speeds;
  std::optional<ParameterCovariance> covariance;  // of the values with intervals, by noise alone
  std::vector<Diagnostic> diagnostics;            // of the verdict; empty where there is none
  std::vector<Assumption> assumptions;
  /// The heat at the end of the log, at its last stamp, `time`: a row for each stage, `energy`,
  /// `second_energy`; empty where nothing warms or the friction cannot be trusted.
  std::vector<EstimatedParameter> state_end;
  /// How E goes with the log's temperature (report/heat_beside_temperature.h); empty where the log has
  /// none, or nothing warms.
  std::vector<EstimatedParameter> temperature;
  std::optional<StructureChoice> choice;  // of identifiers that choose a structure

  /// The parameter of that name, or nullptr.
  const EstimatedParameter* Find(std::string_view name) const;

  /// The message and the warnings behind it, with semicolons between them.
  std::string FullMessage() const;
};

/// The estimate as JSON: {identifier, options{name: text}, status, message, parameters{name: {value, unit, std,
/// interval95}}, metrics{}, holdout{}, without_holdout, trace[{iteration, rmse, parameters{}}], friction{},
/// gravity{}, warnings[], friction_at_speeds[{speed, speed_unit, value, unit, std, interval95}], bands[{quantities[], points[][], value[], std[], interval95[][]}],
/// state_end{time: {value, unit, std, interval95}, energy, second_energy}, temperature{name: as of parameters}, choice{chosen, reason, blocks,
/// trials[{name, rmse, parameters, dropped}]}, covariance{parameters[], matrix[][]}, diagnostics[{test, made, reason, statistic, p, p_adjusted,
/// rejected, effect{value, unit}, moves{}}], assumptions[{name, meaning, moves{}}]};
/// message is the full one, and `warnings` repeats its last clauses where there are any; bands only
/// where maps are, friction_at_speeds where they share a constant with the law. What is absent, or is not a finite number, is null.
nlohmann::json EstimateToJson(const Estimate& estimate);

/// The inverse: null numbers become NaN, parameters come sorted by name. Throws BadInput from
/// `place` for a missing member, a wrong type or an unknown status.
Estimate EstimateFromJson(const nlohmann::json& json, const Place& place);

}  // namespace warmjoint::inline identification
