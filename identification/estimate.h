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
#include "models/foundation/node.h"
#include "models/foundation/parameter_covariance.h"
#include "models/friction/friction_description.h"

namespace warmjoint::inline identification {

struct EstimatedParameter {
  std::string name;
  double value = 0;
  std::string unit;
  std::optional<double> std;  // standard deviation
  std::optional<std::array<double, 2>> interval95;

  /// Without its name, by which a file has it.
  template <class A>
  void Serialize(A* a) {
    a->Field("value", &value, {.needed = kGiveNumber});
    a->Field("unit", &unit, {.needed = "give it as text"});
    a->Field("std", &std, {.at_default = AtDefault::null});
    a->Field("interval95", &interval95, {.at_default = AtDefault::null});
  }
};

/// State of an iterative identifier after one iteration.
struct TraceEntry {
  int iteration = 0;
  std::vector<std::pair<std::string, double>> parameters;
  double rmse = 0;  // over the kept samples, N.m or N

  template <class A>
  void Serialize(A* a) {
    a->Field("iteration", &iteration, {.needed = kGiveNumber});
    a->Field("rmse", &rmse, {.unit = "N.m", .needed = kGiveNumber});
    a->Field("parameters", &parameters, {.needed = "give their values by name"});
  }
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

  template <class A>
  void Serialize(A* a) {
    constexpr FieldInfo or_null{.at_default = AtDefault::null};
    constexpr FieldInfo left_out{.at_default = AtDefault::left_out};
    // who answers, and how sure; the message ends in the warnings
    a->Field("identifier", &identifier, {.needed = "name it"});
    a->Field("options", &options, left_out);
    a->Field("status", &status, {.needed = "say ok, or what failed"});
    std::string full = FullMessage();
    a->Field("message", &full, {.needed = "give it as text"});
    a->Field("warnings", &warnings, left_out);
    TakeMessage(full);

    // numbers, and how well they fit
    a->Named("parameters", &parameters, {.needed = "give them by name"});
    a->Field("metrics", &metrics, or_null);
    a->Field("holdout", &holdout, or_null);
    a->Field("without_holdout", &without_holdout, left_out);
    a->Field("trace", &trace);
    a->Field("friction", &friction, or_null);
    a->Field("gravity", &gravity, or_null);
    a->Field("friction_at_speeds", &at_speeds, left_out);
    a->Field("bands", &bands, left_out);
    a->Field("covariance", &covariance, or_null);

    // what the verdict said, and what only some have
    a->Field("diagnostics", &diagnostics, left_out);
    a->Field("assumptions", &assumptions, left_out);
    a->Named("state_end", &state_end, left_out);
    a->Field("choice", &choice);
  }

 private:
  /// Takes the message without the warnings at its end.
  void TakeMessage(const std::string& full);
};

/// The estimate as a file has it; what is no finite number is null.
Tree EstimateToTree(const Estimate& estimate);

/// The inverse; null numbers become NaN, and keys that nobody knows are left alone. Throws BadInput for a missing member, a
/// wrong type, an unknown status.
Estimate EstimateFrom(const Node& node);

}  // namespace warmjoint::inline identification
