// What is said of an estimate in addition to its numbers: tests for lack of fit, assumptions, the parts of half widths.
#pragma once

#include <warmjoint/field.h>

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace warmjoint {

/// By how much parameters change: name and change in the parameter's own unit.
using ParameterMoves = std::vector<std::pair<std::string, double>>;

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

/// One test for lack of fit: whether the residual depends on something that the model leaves out.
struct Diagnostic {
  std::string test;  // "direction", "lag", ...
  bool made = false;
  std::string reason;
  double statistic = 0;
  double p = 1;
  double p_adjusted = 1;
  bool rejected = false;
  double effect = 0;
  std::string effect_unit;  // of the torque
  ParameterMoves moves;     // empty where they are not known

  template <class A>
  void Serialize(A* a) {
    a->Field("test", &test, {.needed = "name it"});
    a->Field(
        "made", &made,
        {.meaning = "whether the log and the fit let it be made", .needed = "say true or false"});
    a->Field("reason", &reason, OrNull("why it was not made, or what it found"));
    // figures of a test that was made alone
    std::optional<EffectFields> size;
    std::optional<bool> found;
    std::optional<ParameterMoves> biases;
    if (made) {
      size = EffectFields{effect, effect_unit};
      found = rejected;
      biases = moves;
    }
    struct Figure {
      const char* name;
      double* value;
      std::string_view meaning;
    };
    for (const auto& [name, value, meaning] :
         {Figure{"statistic", &statistic,
                 "standard deviations of a normal variable with the same p"},
          Figure{"p", &p, "by chance alone, what was tried within the test counted"},
          Figure{"p_adjusted", &p_adjusted, "with all tests of the log counted (Holm 1979)"}}) {
      std::optional<double> figure;
      if (made) figure = *value;
      a->Field(name, &figure, OrNull(meaning));
      if (made) *value = figure.value_or(std::numeric_limits<double>::quiet_NaN());
    }
    a->Field("rejected", &found, OrNull("p_adjusted is below the error level of the log"));
    a->Field("effect", &size, OrNull("rms over the kept samples of what it explains"));
    a->Field("moves", &biases, OrNull("how each parameter would change, had the model held it"));
    if (!made) return;
    rejected = found.value_or(false);
    if (size) effect = size->value;
    if (size) effect_unit = size->unit;
    moves = biases.value_or(ParameterMoves{});
  }
};

/// Something that no test can see, and its effect.
struct Assumption {
  std::string name;  // "cold_start", "open_drift", ...
  std::string meaning;
  ParameterMoves moves;

  template <class A>
  void Serialize(A* a) {
    a->Field("name", &name, {.needed = "name it"});
    a->Field("meaning", &meaning, {.meaning = "how far off it was taken to be"});
    a->Field("moves", &moves, {.meaning = "of each parameter, were it off by that much"});
  }
};

/// A part of the half width of a parameter's interval, in its unit: by noise, findings, open_drift, ...
struct HalfWidthPart {
  std::string parameter, by;
  double half_width = 0;

  template <class A>
  void Serialize(A* a) {
    a->Field("parameter", &parameter, {.needed = "name it"});
    a->Field("by", &by, {.meaning = "noise, or what else is known", .needed = "name it"});
    a->Field("half_width", &half_width, Needed("", "in the parameter's unit"));
  }
};

}  // namespace warmjoint
