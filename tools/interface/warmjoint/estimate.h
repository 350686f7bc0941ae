// What an identifier answers: the contract's estimate.json as a value.
//
//   const Estimate estimate = ReadEstimate("estimate.json");
//   if (estimate.status != Status::ok) std::puts(estimate.message.c_str());
//   else std::printf("%g N.m\n", estimate.Find("coulomb")->value);
#pragma once

#include <warmjoint/friction.h>

#include <array>
#include <utility>

namespace warmjoint::api {

/// Whether the numbers can be trusted, and if not, why. Failed mathematics is a status and a message, never an exception.
enum class Status { ok, not_converged, not_identifiable, inadequate_model, bad_data };

/// "ok", "not_converged", ...
std::string StatusName(Status status);

/// An estimated parameter; NaN is a number that is not known.
struct Parameter {
  std::string name;
  double value = 0;
  std::string unit{};
  std::optional<double> std{};                        // standard deviation
  std::optional<std::array<double, 2>> interval95{};  // 95 % interval
};

/// Agreement of a fit with n samples. e: measured less fitted.
struct Metrics {
  int n = 0;
  int parameters = 0;               // d
  double effective_parameters = 0;  // trace of the hat matrix; d where nothing is penalised
  double rmse = 0;                  // sqrt(mean(e^2)), N.m or N
  double mae = 0;                   // mean(|e|), N.m or N
  double fit = 0;                   // 100 (1 - |e| / |y - mean(y)|), %
  double fpe = 0;                   // V (1 + d/n)/(1 - d/n), V = mean(e^2)
};

/// State of an iterative identifier after one iteration.
struct TraceEntry {
  int iteration = 0;
  std::vector<std::pair<std::string, double>> parameters{};
  double rmse = 0;  // N.m or N
};

/// What the fit took for gravity beside friction.
struct Gravity {
  std::string kind{};        // sincos, paired or constant
  std::vector<int> knots{};  // paired: those that are known; knot i lies at 2 pi i/64 rad
  std::vector<double>
      values{};  // sincos: of sin and cos; paired: at the knots; constant: one. N.m or N
};

/// Law and maps together at one map's centres.
struct MapBand {
  std::vector<std::string> quantities{};            // of the axes
  std::vector<std::vector<double>> points{};        // [g][axes]
  std::vector<double> value{};                      // [g] N.m or N
  std::vector<double> std{};                        // [g]
  std::vector<std::array<double, 2>> interval95{};  // [g]
};

/// What law and maps brake with at one speed, the mean over the places of the samples.
struct FrictionAtSpeed {
  double speed = 0;
  double value = 0;
  double std = 0;
  std::array<double, 2> interval95{};
  std::string speed_unit{}, unit{};  // "rad/s" or "m/s", and the unit of the torque
};

/// Covariance of the values with intervals, by noise alone.
struct Covariance {
  std::vector<std::string> parameters{};      // [p] names
  std::vector<std::vector<double>> matrix{};  // [p][p] in products of their units
};

/// One test for lack of fit.
struct Diagnostic {
  std::string test{};
  bool made = false;      // whether log and fit let it be made
  std::string reason{};   // why not, or what it found
  double statistic = 0;   // z-score
  double p = 1;           // by chance alone
  double p_adjusted = 1;  // with all tests of the log counted
  bool rejected = false;
  double effect = 0;  // rms of what it explains, in effect_unit
  std::string effect_unit{};
  std::vector<std::pair<std::string, double>> moves{};  // of each parameter, had the model held it
};

/// Something that no test can see, and what it would do.
struct Assumption {
  std::string name{}, meaning{};
  std::vector<std::pair<std::string, double>> moves{};
};

/// A structure that an identifier tried.
struct StructureTrial {
  std::string name{};
  std::optional<double> rmse{};  // on held-out blocks, N.m or N
  double parameters = 0;         // effective number
  std::string dropped{};         // why it was no contender; empty for one that was
};

/// Which of several structures was chosen, and why.
struct StructureChoice {
  std::string chosen{};
  std::string reason{};
  int blocks = 0;  // of time that were held out in turn
  std::vector<StructureTrial> trials{};
};

/// The heat that an earlier recording left at the first sample of this one (IdentifySettings::follows).
struct CarriedHeat {
  std::string file{};            // that told of it
  double pause = 0;              // s at rest between them
  std::string pause_from{};      // "stamps" of both, or "given"
  std::string unit{};            // "N.m" or "N"
  std::vector<double> energy{};  // E(0) as it was expected, of each stage of warming
  std::vector<double> std{};     // standard deviation of each
};

struct Estimate {
  std::string identifier{};
  std::map<std::string, std::string> options{};  // of the identifier, those not at their defaults
  Status status = Status::ok;
  std::string message{};                // for a failure: what is wrong and what would help
  std::vector<std::string> warnings{};  // what must be known before numbers that pass are used
  std::vector<Parameter> parameters{};  // empty where nothing trustworthy is known
  std::optional<Metrics> metrics{};
  std::optional<Metrics> holdout{};  // on samples that the fit has not seen
  std::vector<TraceEntry> trace{};
  std::optional<Friction>
      friction{};  // none where it cannot be trusted, or MuJoCo cannot use its unit
  std::optional<Gravity> gravity{};
  std::vector<MapBand> bands{};  // one for each of the friction's maps
  /// Where a map can imitate a constant of the law, in place of that constant.
  std::vector<FrictionAtSpeed> friction_at_speeds{};
  std::optional<Covariance> covariance{};
  std::vector<Diagnostic> diagnostics{};
  std::vector<Assumption> assumptions{};
  std::optional<Origin>
      recording{};  // the files that it tells of; none of recordings that were made of vectors
  std::optional<CarriedHeat> follows{};     // with what it began; none without an earlier recording
  std::vector<Parameter> state_end{};       // at the end of the log: time, energy, second_energy
  std::string without_holdout{};            // why `holdout` is none, where it was asked for
  std::optional<StructureChoice> choice{};  // of identifiers that choose a structure

  /// The parameter of that name, or nullptr.
  const Parameter* Find(const std::string& name) const;
};

/// The text of estimate.json, as `warmjoint identify -o` writes it, but for its recordings, which are named
/// as they are. What is no finite number is null.
std::string EstimateToJson(const Estimate& estimate);

/// The inverse: null numbers become NaN, parameters come sorted by name, the warnings at the end of `message` are taken off.
/// name: of the text in messages. Throws BadInput.
Estimate EstimateFromJson(const std::string& text, const std::string& name = "estimate");

/// Reads estimate.json. Throws BadInput.
Estimate ReadEstimate(const std::filesystem::path& file);

/// Writes it as a whole. Throws BadInput and OutputFailed.
void WriteEstimate(const Estimate& estimate, const std::filesystem::path& file);

}  // namespace warmjoint::api
