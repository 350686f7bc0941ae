// What a verdict asked about a fit, and what was assumed, as data.
#pragma once

#include <string>
#include <utility>
#include <vector>

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
};

/// Something that no test can see, and what it would do.
struct Assumption {
  std::string name;      // "cold_start", "open_drift", ...
  std::string meaning;   // how far off it was taken to be: a clause
  ParameterMoves moves;  // of each parameter, were it off by that much
};

}  // namespace warmjoint::inline identification
