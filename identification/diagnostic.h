// What a verdict asked about a fit, and what was assumed, as data.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "models/foundation/field.h"

namespace warmjoint::inline identification {

/// By how much parameters change: name and change in the parameter's own unit.
using ParameterMoves = std::vector<std::pair<std::string, double>>;

/// One test for lack of fit: whether the residual depends on something that the model leaves out.
struct Diagnostic {
  std::string test;         // "direction", "lag", ...
  bool made = false;        // whether the log and the fit let it be made
  std::string reason;       // why it was not made, or what it found; a clause
  double statistic = 0;     // z-score: standard deviations of a normal variable with the same p
  double p = 1;             // by chance alone, what was tried within the test counted
  double p_adjusted = 1;    // with all tests of the log counted (Holm 1979)
  bool rejected = false;    // p_adjusted is below the error level of the log
  double effect = 0;        // rms over the kept samples of what it explains, N.m or N
  std::string effect_unit;  // of the torque
  ParameterMoves moves;     // had the model held it; empty where that is not known

  template <class A>
  void Serialize(A* a);
};

/// Something that no test can see, and what it would do.
struct Assumption {
  std::string name;      // "cold_start", "open_drift", ...
  std::string meaning;   // how far off it was taken to be: a clause
  ParameterMoves moves;  // of each parameter, were it off by that much

  template <class A>
  void Serialize(A* a) {
    a->Field("name", &name, {.needed = "name it"});
    a->Field("meaning", &meaning);
    a->Field("moves", &moves);
  }
};

/// The effect of a diagnostic as files have it.
struct EffectFields {
  double value = 0;
  std::string unit;

  template <class A>
  void Serialize(A* a) {
    a->Field("value", &value, {.needed = kGiveNumber});
    a->Field("unit", &unit);
  }
};

template <class A>
void Diagnostic::Serialize(A* a) {
  constexpr FieldInfo or_null{.at_default = AtDefault::null};
  a->Field("test", &test, {.needed = "name it"});
  a->Field("made", &made, {.needed = "say true or false"});
  a->Field("reason", &reason, or_null);
  // figures of a test that was made alone
  std::optional<EffectFields> size;
  std::optional<bool> found;
  std::optional<ParameterMoves> biases;
  if (made) {
    size = EffectFields{effect, effect_unit};
    found = rejected;
    biases = moves;
  }
  for (const auto& [name, value] : {std::pair("statistic", &statistic), std::pair("p", &p),
                                    std::pair("p_adjusted", &p_adjusted)}) {
    std::optional<double> figure;
    if (made) figure = *value;
    a->Field(name, &figure, or_null);
    if (made) *value = figure.value_or(std::numeric_limits<double>::quiet_NaN());
  }
  a->Field("rejected", &found, or_null);
  a->Field("effect", &size, or_null);
  a->Field("moves", &biases, or_null);
  if (!made) return;
  rejected = found.value_or(false);
  if (size) effect = size->value;
  if (size) effect_unit = size->unit;
  moves = biases.value_or(ParameterMoves{});
}

}  // namespace warmjoint::inline identification
