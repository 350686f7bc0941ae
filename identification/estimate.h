// What an identifier answers.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "identification/chosen_structure.h"
#include "identification/diagnostic.h"
#include "identification/gravity.h"
#include "identification/map_band.h"
#include "identification/metrics.h"
#include "identification/status.h"
#include "models/friction/friction_description.h"

namespace warmjoint::inline identification {

struct EstimatedParameter {
  std::string name;
  double value = 0;
  std::string unit;
  std::optional<double> std;  // standard deviation
  std::optional<std::array<double, 2>> interval95;
};

/// State of an iterative identifier after one iteration.
struct TraceEntry {
  int iteration = 0;
  std::vector<std::pair<std::string, double>> parameters;
  double rmse = 0;  // over the kept samples, N.m or N
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
  /// Beside maps, in place of parameters of the law that only the prior tells: friction at a low, the
  /// median and a high speed of each direction.
  std::vector<FrictionAtSpeed> at_speeds;
  std::optional<ParameterCovariance> covariance;  // of the values with intervals, by noise alone
  std::vector<Diagnostic> diagnostics;            // of the verdict; empty where there is none
  std::vector<Assumption> assumptions;
  /// The heat at the end of the log, at its last stamp, `time`: a row for each stage, `energy`,
  /// `second_energy`; empty where nothing warms or the friction cannot be trusted.
  std::vector<EstimatedParameter> state_end;
  std::optional<StructureChoice> choice;  // of identifiers that choose a structure

  /// The parameter of that name, or nullptr.
  const EstimatedParameter* Find(std::string_view name) const;

  /// The message and the warnings behind it, with semicolons between them.
  std::string FullMessage() const;
};

}  // namespace warmjoint::inline identification
