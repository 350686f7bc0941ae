// What an identifier answers: the contract's estimate.json as a value.
//
//   const Estimate estimate = ReadEstimate("estimate.json");
//   if (estimate.status != Status::ok) std::puts(estimate.message.c_str());
//   else std::printf("%g N.m\n", estimate.Find("coulomb")->value);
#pragma once

#include <warmjoint/diagnostics.h>
#include <warmjoint/parameter_covariance.h>
#include <warmjoint/recording.h>

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace warmjoint {

/// Whether the numbers can be trusted, and if not, why.
enum class Status { ok, not_converged, not_identifiable, inadequate_model, bad_data };

inline std::span<const Word<Status>> WordsOf(Status) {
  static constexpr std::array words{
      Word{"ok", Status::ok}, Word{"not_converged", Status::not_converged},
      Word{"not_identifiable", Status::not_identifiable},
      Word{"inadequate_model", Status::inadequate_model}, Word{"bad_data", Status::bad_data}};
  return words;
}

/// "ok", "not_converged", ...
inline std::string_view StatusName(Status status) { return NameOf(status); }

/// An estimated parameter; NaN is a number that is not known.
struct EstimatedParameter {
  std::string name;
  double value = 0;
  std::string unit;
  std::optional<double> std;
  std::optional<std::array<double, 2>> interval95;

  /// Its fields without the name, which is the key in a file.
  template <class A>
  void Serialize(A* a) {
    a->Field("value", &value, {.needed = kGiveNumber});
    a->Field("unit", &unit, {.needed = "give it as text"});
    a->Field("std", &std,
             OrNull("standard deviation; null where the data leave the parameter open"));
    a->Field("interval95", &interval95, {.at_default = AtDefault::null});
  }
};

/// Agreement of a fit with the samples that it kept. y: measured, yhat: fitted, e = y - yhat.
struct Metrics {
  int n = 0;
  int parameters = 0;
  double effective_parameters = 0;
  double rmse = 0;
  double mae = 0;
  double fit = 0;
  double fpe = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("n", &n, Needed("", "samples"));
    a->Field("parameters", &parameters, Needed("", "d, their number"));
    a->Field("effective_parameters", &effective_parameters,
             Needed("", "trace of the hat matrix; d where nothing is penalised"));
    a->Field("rmse", &rmse, Needed("N.m", "sqrt(mean(e^2))"));
    a->Field("mae", &mae, Needed("N.m", "mean(|e|)"));
    a->Field("fit", &fit, Needed("%", "100 (1 - |e| / |y - mean(y)|)"));
    a->Field("fpe", &fpe, Needed("(N.m)^2", "V (1 + d/n) / (1 - d/n), V = mean(e^2)"));
  }
};

/// Metrics of a fit. measured, fitted: [n] N.m or N. Throws BadInput for unlike lengths and no sample.
Metrics ComputeMetrics(const Eigen::VectorXd& measured, const Eigen::VectorXd& fitted,
                       int parameters, double effective_parameters);

/// State of an iterative identifier after one iteration.
struct TraceEntry {
  int iteration = 0;
  std::vector<std::pair<std::string, double>> parameters;
  double rmse = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("iteration", &iteration, {.needed = kGiveNumber});
    a->Field("rmse", &rmse, Needed("N.m", "over the kept samples"));
    a->Field("parameters", &parameters, {.needed = "give their values by name"});
  }
};

/// How G depends on the position p, linear in its values g:
///   sincos    g1 sin p + g2 cos p, rotary joints
///   paired    any periodic G(p), rotary joints: straight lines between 64 knots on the turn
///   constant  g1: what `paired` is for a linear joint, whose weight does not depend on p
enum class GravityKind { sincos, paired, constant };

inline std::span<const Word<GravityKind>> WordsOf(GravityKind) {
  static constexpr std::array words{Word{"sincos", GravityKind::sincos},
                                    Word{"paired", GravityKind::paired},
                                    Word{"constant", GravityKind::constant}};
  return words;
}

/// Gravity as options ask for it.
enum class FittedGravity { none, sincos, paired };
inline std::span<const Word<FittedGravity>> WordsOf(FittedGravity) {
  static constexpr std::array words{Word{"none", FittedGravity::none},
                                    Word{"sincos", FittedGravity::sincos},
                                    Word{"paired", FittedGravity::paired}};
  return words;
}

/// The samples that take part, as options ask for them.
enum class MotionKind { chosen, constant, any };
inline std::span<const Word<MotionKind>> WordsOf(MotionKind) {
  static constexpr std::array words{Word{"chosen", MotionKind::chosen},
                                    Word{"constant", MotionKind::constant},
                                    Word{"any", MotionKind::any}};
  return words;
}

/// What is known of the heat at the start of a log.
enum class StartBelief {
  cold,     // the joint was cold: intervals hold under that condition
  unknown,  // it may have been a tenth as warm as it gets: intervals are widened by the bias from that
  estimated,  // E(0) is fitted
};
inline std::span<const Word<StartBelief>> WordsOf(StartBelief) {
  static constexpr std::array words{Word{"cold", StartBelief::cold},
                                    Word{"unknown", StartBelief::unknown},
                                    Word{"estimated", StartBelief::estimated}};
  return words;
}

/// Gravity with its values.
struct GravityModel {
  GravityKind kind = GravityKind::sincos;
  std::vector<int> knots;  // paired: [m] those that are known, ascending; knot i: 2 pi i/64 rad
  Eigen::VectorXd values;  // sincos: [2]; paired: [m] torque at the knots; constant: [1]. N.m or N

  /// Whether G is known at a position (rad or m): for `paired` it is, between neighbouring knots.
  bool Covers(double position) const;

  /// G at positions that are covered. position: [N] rad or m; returns [N] N.m or N.
  Eigen::VectorXd Torque(const Eigen::VectorXd& position) const;
};

/// Law and maps together at one map's centres (make_bands.h), each by itself with 95 %.
struct MapBand {
  std::vector<std::string> quantities;
  std::vector<std::vector<double>> points;        // [g][axes]
  std::vector<double> value;                      // [g] N.m or N
  std::vector<double> std;                        // [g]
  std::vector<std::array<double, 2>> interval95;  // [g]

  template <class A>
  void Serialize(A* a) {
    constexpr std::string_view needed = "give a value for each centre";
    a->Field("quantities", &quantities,
             {.meaning = "of the axes", .needed = "name those of the axes"});
    a->Field("points", &points, {.meaning = "[g][axes] rad, ...", .needed = needed});
    a->Field("value", &value, {.unit = "N.m", .needed = needed});
    a->Field("std", &std, {.unit = "N.m", .needed = needed});
    a->Field("interval95", &interval95, {.unit = "N.m", .needed = needed});
  }
};

/// The friction of law and maps at one speed: with maps the mean over the places of kept samples at that speed, and of a
/// friction that grows with the load under the mean load of these.
struct FrictionAtSpeed {
  double speed = 0;
  double value = 0;
  double std = 0;
  std::array<double, 2> interval95{};
  std::string speed_unit{}, unit{};  // of a report; empty in a file that lacks them
  /// E with which the joint slides, N.m or N: 0 of a cold one, else that of the log's warmest moment; none where nothing warms.
  std::optional<double> energy{};

  template <class A>
  void Serialize(A* a) {
    a->Field("speed", &speed, Needed("rad/s", "below 0: backwards"));
    a->Field("value", &value, {.unit = "N.m", .needed = kGiveNumber});
    a->Field("std", &std, {.unit = "N.m", .needed = kGiveNumber});
    a->Field("interval95", &interval95, {.unit = "N.m", .needed = "give [lower, upper]"});
    a->Field("speed_unit", &speed_unit, {.at_default = AtDefault::left_out});
    a->Field("unit", &unit, {.at_default = AtDefault::left_out});
    a->Field("energy", &energy,
             {.unit = "N.m",
              .meaning = "heat E: 0 of a cold joint, else that of the log's warmest moment; left "
                         "out where nothing warms",
              .at_default = AtDefault::left_out});
  }
};

/// A structure that was tried.
struct StructureTrial {
  std::string name;
  std::optional<double> rmse;
  double parameters = 0;
  std::string dropped;

  template <class A>
  void Serialize(A* a) {
    a->Field(
        "name", &name,
        {.meaning = "identifier and options, as \"energy-ml law=coulomb\"", .needed = "name it"});
    a->Field("rmse", &rmse,
             {.unit = "N.m",
              .meaning = "on held-out blocks; null where it was dropped before",
              .at_default = AtDefault::null});
    a->Field("parameters", &parameters,
             {.meaning = "effective number; 0 where nothing was fitted"});
    a->Field("dropped", &dropped, OrNull("why it was no contender; null for one that was"));
  }
};

/// Which of several structures was chosen, and why.
struct StructureChoice {
  std::string chosen;
  std::string reason;
  int blocks = 0;
  std::vector<StructureTrial> trials;

  template <class A>
  void Serialize(A* a) {
    a->Field("chosen", &chosen,
             {.meaning = "empty where nothing fitted", .needed = "name a structure"});
    a->Field("reason", &reason, {.meaning = "one clause"});
    a->Field("blocks", &blocks, {.meaning = "of time that were held out in turn"});
    a->Field("trials", &trials);
  }
};

/// A stage of carried heat as files have it.
struct CarriedStage {
  double value = 0;  // N.m or N
  std::string unit;
  double std = 0;  // of value

  template <class A>
  void Serialize(A* a) {
    a->Field("value", &value, {.needed = kGiveNumber});
    a->Field("unit", &unit, {.needed = "give it as text"});
    a->Field("std", &std, {.needed = kGiveNumber});
  }
};

/// The part that is left of an earlier recording's heat at the first sample of the next, E(0) = E exp(-pause/tau) for each
/// stage, Eq. (22) without losses.
struct CarriedHeat {
  std::string file;
  double pause = 0;
  std::string pause_from;
  std::string unit;
  std::vector<double> energy;  // of each stage, N.m or N
  std::vector<double> std;     // the deviations by E and by tau added up, as if one error made both

  /// The `follows` member of an estimate file: {file, pause, pause_from, energy{value, unit, std}}, and second_energy.
  template <class A>
  void Serialize(A* a) {
    a->Field("file", &file, {.meaning = "the recording before", .needed = "name it"});
    a->Field("pause", &pause, Needed("s", "at rest"));
    a->Field("pause_from", &pause_from,
             {.meaning = "stamps or given", .needed = "say stamps or given"});
    const char* const keys[] = {"energy", "second_energy"};
    for (size_t i = 0; i < 2; ++i) {
      std::optional<CarriedStage> stage;
      if (i < energy.size()) stage = CarriedStage{energy[i], unit, std[i]};
      a->Field(keys[i], &stage);
      if (!stage || i < energy.size()) continue;
      energy.push_back(stage->value);
      std.push_back(stage->std);
      unit = stage->unit;
    }
  }
};

/// The time at the ends of constant-speed segments in which a torque had not settled after a change of speed, or had begun to
/// change before one. The fit leaves the samples there out.
struct Settling {
  double after = 0;   // a change of speed, s
  double before = 0;  // the next one, s

  double both() const { return after + before; }

  template <class A>
  void Serialize(A* a) {
    a->Field("after", &after, Needed("s", "from each change of speed on", kNotNegative));
    a->Field("before", &before, Needed("s", "until the next one", kNotNegative));
  }
};

/// Change of the friction (law and heat, rms) by what a model leaves out from which it is refused, as a share,
/// by default (`--relevance`).
inline constexpr double kDefaultRelevance = 0.1;

/// What an identifier answers.
struct Estimate {
  std::string identifier;
  std::map<std::string, std::string> options;
  Status status = Status::ok;
  std::string message;                // without the warnings
  std::vector<std::string> warnings;  // "the kernels can imitate coulomb, ..."; of an ok alone
  std::vector<EstimatedParameter> parameters;  // empty where nothing trustworthy is known
  std::optional<Metrics> metrics;
  std::optional<Metrics> holdout;
  std::string without_holdout;  // empty: there is one, or none was tried
  std::vector<TraceEntry> trace;
  std::optional<Friction> friction;
  std::optional<GravityModel> gravity;
  std::vector<MapBand> bands;
  std::vector<FrictionAtSpeed> friction_at_speeds;
  std::optional<ParameterCovariance> covariance;
  std::vector<Diagnostic> diagnostics;
  std::vector<Assumption> assumptions;
  /// The parts of the half widths of intervals that are wider than by noise alone; the parts of one add up.
  std::vector<HalfWidthPart> half_widths;
  std::vector<EstimatedParameter> state_end;  // empty where nothing warms or nothing is trusted
  std::optional<StructureChoice> choice;
  std::optional<CarriedHeat> follows;
  /// The files of its log, as seen from here; none of a log that was made of vectors.
  std::optional<RecordingSource> recording;
  std::optional<Settling> settling;

  /// The parameter of that name, or nullptr.
  const EstimatedParameter* Find(std::string_view name) const;

  /// The message, followed by the warnings, with semicolons between them.
  std::string FullMessage() const;

  template <class A>
  void Serialize(A* a) {
    // the identifier and the status; the message ends in the warnings
    a->Field("identifier", &identifier,
             {.meaning = "one of `warmjoint list identifiers`", .needed = "name it"});
    a->Field("options", &options,
             LeftOut("of the identifier, those that are not at their defaults"));
    a->Field("status", &status,
             {.meaning = "ok: the numbers can be used; all others end `identify` with status 3",
              .needed = "say ok, or what failed"});
    std::string full = FullMessage();
    a->Field(
        "message", &full,
        {.meaning = "one sentence with the remedy, and the warnings", .needed = "give it as text"});
    a->Field("warnings", &warnings,
             LeftOut("what must be known before the numbers are used, a clause each"));
    TakeMessage(full);

    // numbers, and how well they fit
    a->Named("parameters", &parameters,
             {.meaning = "each estimated parameter by its name", .needed = "give them by name"});
    a->Field("metrics", &metrics, OrNull("agreement with all the data"));
    a->Field("holdout", &holdout,
             OrNull("agreement with data that a second fit has not seen (--holdout)"));
    a->Field("without_holdout", &without_holdout, LeftOut("why there is none"));
    a->Field("trace", &trace, {.meaning = "the parameters after each iteration, from the start"});
    a->Field(
        "friction", &friction,
        OrNull("what plugin, `attach` and scenarios read; null where nothing is to be trusted"));
    a->Field("gravity", &gravity, OrNull("what --gravity fitted"));
    a->Field(
        "friction_at_speeds", &friction_at_speeds,
        LeftOut(
            "what law and maps brake with together at a low, the median and a high speed of each "
            "direction, cold and, where a law warms, at the log's warmest moment"));
    a->Field("bands", &bands, LeftOut("law and maps together at the centres of each map"));
    a->Field("covariance", &covariance, OrNull("of the values with intervals, by noise alone"));

    // the verdict, and members that only some estimates have
    a->Field("diagnostics", &diagnostics,
             LeftOut("every test for lack of fit; figures of one that was not made are null"));
    a->Field("assumptions", &assumptions,
             LeftOut("what no test can see, and how far the answer would move if it were wrong"));
    a->Field(
        "half_widths", &half_widths,
        LeftOut("parts of the half width of each interval that reaches farther than noise has it"));
    a->Named(
        "state_end", &state_end,
        LeftOut("heat at the end of the log, `energy` and `second_energy`, and its stamp, `time`"));
    a->Field("choice", &choice,
             {.meaning = "which structure an identifier chose that compares several"});

    a->Field("settling", &settling,
             {.meaning = "samples at the ends of constant-speed segments that the fit leaves out, "
                         "since the torque had not settled there"});

    // the log that it was made of; the project file has a member of its own
    a->Field("follows", &follows,
             {.meaning = "what an earlier recording left of its heat (--follows)"});
    std::optional<TakenProject> project;
    if (recording) project = recording->project;
    a->Field("recording", &recording,
             {.meaning = "the files that were read, and the options that read them"});
    a->Field("project", &project,
             {.meaning = "the project file of the recording, and what was taken of it"});
    if (recording) recording->project = project;
  }

 private:
  /// Takes the message without the warnings at its end.
  void TakeMessage(const std::string& full);
};

/// The text of estimate.json; what is no finite number is null. target: the file that it is for, from whose folder recordings
/// are named; empty: as they are.
std::string EstimateToJson(const Estimate& estimate, const std::filesystem::path& target = {});

/// The inverse; null numbers become NaN, the warnings at the end of `message` are separated from it, and unknown keys are
/// ignored. name: of the text in messages. Throws BadInput for a missing member, a wrong type, an unknown status.
Estimate EstimateFromJson(const std::string& text, const std::string& name = "estimate");

/// Reads estimate.json. Its recordings are looked for relative to its folder, by the path as it is written, and next to it.
/// Throws BadInput.
Estimate ReadEstimate(const std::filesystem::path& file);

/// Writes it as a whole; its recordings are named as seen from the file's folder, so that both can be found from anywhere and
/// moved together. Throws BadInput and OutputFailed.
void WriteEstimate(const Estimate& estimate, const std::filesystem::path& file);

}  // namespace warmjoint
