#include "identification/estimate_from_json.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "identification/gravity_json.h"
#include "identification/map_band_json.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/matrix_json.h"
#include "models/foundation/nearest_name.h"
#include "models/friction/friction_json.h"

namespace warmjoint::inline identification {
namespace {

using nlohmann::json;

// a member that is absent counts as null

const json& Member(const json& object, const char* key, const char* owner, const Place& place) {
  if (!object.is_object())
    Refuse(place, "{} is {}; it must be an object", owner, Excerpt(object.dump()));
  static const json null;
  const auto found = object.find(key);
  return found == object.end() ? null : *found;
}

double ToNumber(const json& value, const char* name, const Place& place) {
  if (value.is_null()) return std::numeric_limits<double>::quiet_NaN();
  if (!value.is_number())
    Refuse(place, "{} is {}; it must be a number", name, Excerpt(value.dump()));
  return value.get<double>();
}

int ToInteger(const json& value, const char* name, const Place& place) {
  if (!value.is_number_integer()) {
    Refuse(place, "{} is {}; it must be a whole number", name, Excerpt(value.dump()));
  }
  return value.get<int>();
}

std::string ToText(const json& value, const char* name, const Place& place) {
  if (!value.is_string()) Refuse(place, "{} is {}; it must be text", name, Excerpt(value.dump()));
  return value.get<std::string>();
}

Status ToStatus(const json& value, const Place& place) {
  const std::string name = ToText(value, "status", place);
  std::vector<std::string> known;
  for (const Status status : kStatuses) {
    if (name == StatusName(status)) return status;
    known.emplace_back(StatusName(status));
  }
  Refuse(place, "there is no status '{}'{}", Excerpt(name), Suggestion(name, known));
}

/// The message without the clauses that repeat the warnings at its end, the last first.
void TakeOffWarnings(Estimate& estimate) {
  // the last warning first, each with its separator
  for (auto warning = estimate.warnings.rbegin(); warning != estimate.warnings.rend(); ++warning) {
    std::string& message = estimate.message;
    if (!message.ends_with(*warning)) return;
    message.resize(message.size() - warning->size());
    if (message.ends_with("; ")) message.resize(message.size() - 2);
  }
}

EstimatedParameter ToParameter(const std::string& name, const json& object, const Place& place) {
  EstimatedParameter parameter;
  parameter.name = name;
  parameter.value = ToNumber(Member(object, "value", name.c_str(), place), "value", place);
  parameter.unit = ToText(Member(object, "unit", name.c_str(), place), "unit", place);

  // null where nothing is known
  const json& deviation = Member(object, "std", name.c_str(), place);
  if (!deviation.is_null()) parameter.std = ToNumber(deviation, "std", place);
  const json& interval = Member(object, "interval95", name.c_str(), place);
  if (interval.is_null()) return parameter;
  if (!interval.is_array() || interval.size() != 2) {
    Refuse(place, "interval95 of {} is {}; it must be [lower, upper]", Excerpt(name),
           Excerpt(interval.dump()));
  }
  parameter.interval95 = {ToNumber(interval[0], "interval95", place),
                          ToNumber(interval[1], "interval95", place)};
  return parameter;
}

FrictionAtSpeed ToFrictionAtSpeed(const json& object, const Place& place) {
  const auto number = [&](const char* key) {
    return ToNumber(Member(object, key, "friction_at_speeds", place), key, place);
  };
  const json& interval = Member(object, "interval95", "friction_at_speeds", place);
  if (!interval.is_array() || interval.size() != 2) {
    Refuse(place, "interval95 of friction_at_speeds is {}; it must be [lower, upper]",
           Excerpt(interval.dump()));
  }
  FrictionAtSpeed one{
      number("speed"),
      number("value"),
      number("std"),
      {ToNumber(interval[0], "interval95", place), ToNumber(interval[1], "interval95", place)}};
  if (object.contains("speed_unit"))
    one.speed_unit = ToText(object["speed_unit"], "speed_unit", place);
  if (object.contains("unit")) one.unit = ToText(object["unit"], "unit", place);
  return one;
}

std::optional<Metrics> ToMetrics(const json& object, const char* owner, const Place& place) {
  if (object.is_null()) return std::nullopt;
  const auto number = [&](const char* key) {
    return ToNumber(Member(object, key, owner, place), key, place);
  };
  Metrics metrics;
  metrics.n = ToInteger(Member(object, "n", owner, place), "n", place);
  metrics.parameters = ToInteger(Member(object, "parameters", owner, place), "parameters", place);
  metrics.effective_parameters = number("effective_parameters");
  metrics.rmse = number("rmse");
  metrics.mae = number("mae");
  metrics.fit = number("fit");
  metrics.fpe = number("fpe");
  return metrics;
}

TraceEntry ToTraceEntry(const json& object, const Place& place) {
  TraceEntry entry;
  entry.iteration = ToInteger(Member(object, "iteration", "trace", place), "iteration", place);
  entry.rmse = ToNumber(Member(object, "rmse", "trace", place), "rmse", place);
  for (const auto& [name, value] : Member(object, "parameters", "trace", place).items()) {
    entry.parameters.emplace_back(name, ToNumber(value, name.c_str(), place));
  }
  return entry;
}

/// Square, one row for each name.
std::optional<ParameterCovariance> ToCovariance(const json& object, const Place& place) {
  if (object.is_null()) return std::nullopt;
  ParameterCovariance covariance;
  // the names tell how large the matrix must be
  for (const json& name : Member(object, "parameters", "covariance", place)) {
    covariance.parameters.push_back(ToText(name, "a parameter of covariance", place));
  }
  covariance.matrix = SquareFromJson(Member(object, "matrix", "covariance", place),
                                     covariance.parameters.size(), "covariance.matrix", place);
  return covariance;
}

ParameterMoves ToMoves(const json& object, const Place& place) {
  ParameterMoves moves;
  for (const auto& [name, move] : object.items()) {
    moves.emplace_back(name, ToNumber(move, name.c_str(), place));
  }
  return moves;
}

bool ToTruth(const json& value, const char* name, const Place& place) {
  if (!value.is_boolean()) {
    Refuse(place, "{} is {}; it must be true or false", name, Excerpt(value.dump()));
  }
  return value.get<bool>();
}

Diagnostic ToDiagnostic(const json& object, const Place& place) {
  const auto member = [&](const char* key) -> const json& {
    return Member(object, key, "a diagnostic", place);
  };
  Diagnostic one;
  one.test = ToText(member("test"), "test", place);
  one.made = ToTruth(member("made"), "made", place);
  if (!member("reason").is_null()) one.reason = ToText(member("reason"), "reason", place);
  // a test that was not made has no figures
  if (!one.made) return one;
  one.statistic = ToNumber(member("statistic"), "statistic", place);
  one.p = ToNumber(member("p"), "p", place);
  one.p_adjusted = ToNumber(member("p_adjusted"), "p_adjusted", place);
  one.rejected = ToTruth(member("rejected"), "rejected", place);
  const json& effect = member("effect");
  one.effect = ToNumber(Member(effect, "value", "effect", place), "effect.value", place);
  one.effect_unit = ToText(Member(effect, "unit", "effect", place), "effect.unit", place);
  one.moves = ToMoves(member("moves"), place);
  return one;
}

StructureChoice ToChoice(const json& object, const Place& place) {
  const auto member = [&](const char* key) -> const json& {
    return Member(object, key, "choice", place);
  };
  StructureChoice choice;
  choice.chosen = ToText(member("chosen"), "chosen", place);
  choice.reason = ToText(member("reason"), "reason", place);
  choice.blocks = ToInteger(member("blocks"), "blocks", place);
  // the structures that were tried
  for (const json& one : member("trials")) {
    const auto of = [&](const char* key) -> const json& {
      return Member(one, key, "a trial", place);
    };
    StructureTrial& trial = choice.trials.emplace_back();
    trial.name = ToText(of("name"), "name", place);
    if (!of("rmse").is_null()) trial.rmse = ToNumber(of("rmse"), "rmse", place);
    trial.parameters = ToNumber(of("parameters"), "parameters", place);
    if (!of("dropped").is_null()) trial.dropped = ToText(of("dropped"), "dropped", place);
  }
  return choice;
}

Assumption ToAssumption(const json& object, const Place& place) {
  const auto member = [&](const char* key) -> const json& {
    return Member(object, key, "an assumption", place);
  };
  return {ToText(member("name"), "name", place), ToText(member("meaning"), "meaning", place),
          ToMoves(member("moves"), place)};
}

/// The members of an estimate's object by name.
class Members {
 public:
  Members(const json& object, const Place& place) : object_(object), place_(place) {}
  const json& operator()(const char* key) const {
    return Member(object_, key, "the estimate", place_);
  }

 private:
  const json& object_;
  const Place& place_;
};

void TakeNumbers(const Members& member, const Place& place, Estimate& estimate) {
  // parameters, and how well they fit
  const json& parameters = member("parameters");
  if (!parameters.is_object()) Refuse(place, "parameters must be an object");
  for (const auto& [name, value] : parameters.items()) {
    estimate.parameters.push_back(ToParameter(name, value, place));
  }
  estimate.metrics = ToMetrics(member("metrics"), "metrics", place);
  estimate.holdout = ToMetrics(member("holdout"), "holdout", place);
  for (const json& entry : member("trace")) estimate.trace.push_back(ToTraceEntry(entry, place));
  // bands of maps, and friction at some speeds
  for (const json& band : member("bands")) estimate.bands.push_back(BandFromJson(band, place));
  for (const json& one : member("friction_at_speeds")) {
    estimate.at_speeds.push_back(ToFrictionAtSpeed(one, place));
  }
}

void TakeModel(const Members& member, const Place& place, Estimate& estimate) {
  if (!member("friction").is_null()) {
    estimate.friction = FrictionFromJson(member("friction"), place);
  }
  if (!member("gravity").is_null()) {
    estimate.gravity = GravityFromJson(member("gravity"), place);
  }
  estimate.covariance = ToCovariance(member("covariance"), place);
}

void TakeWhatOnlySomeHave(const Members& member, const Place& place, Estimate& estimate) {
  for (const auto& [name, value] : member("state_end").items()) {
    estimate.state_end.push_back(ToParameter(name, value, place));
  }
  if (!member("without_holdout").is_null()) {
    estimate.without_holdout = ToText(member("without_holdout"), "without_holdout", place);
  }
  if (!member("choice").is_null()) estimate.choice = ToChoice(member("choice"), place);
}

}  // namespace

Estimate EstimateFromJson(const json& object, const Place& place) {
  const Members member(object, place);

  // who answers, and how sure
  Estimate estimate;
  estimate.identifier = ToText(member("identifier"), "identifier", place);
  for (const auto& [name, value] : member("options").items()) {
    estimate.options[name] = ToText(value, "an option", place);
  }
  estimate.status = ToStatus(member("status"), place);
  estimate.message = ToText(member("message"), "message", place);
  for (const json& warning : member("warnings")) {
    estimate.warnings.push_back(ToText(warning, "a warning", place));
  }
  TakeOffWarnings(estimate);

  TakeNumbers(member, place, estimate);
  TakeModel(member, place, estimate);

  // what the verdict said
  for (const json& one : member("diagnostics")) {
    estimate.diagnostics.push_back(ToDiagnostic(one, place));
  }
  for (const json& one : member("assumptions")) {
    estimate.assumptions.push_back(ToAssumption(one, place));
  }
  TakeWhatOnlySomeHave(member, place, estimate);
  return estimate;
}

}  // namespace warmjoint::inline identification
