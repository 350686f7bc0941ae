// Of a law with gravity, inertia and load: parameters outside of their bounds, and columns that the motion does not distinguish.
#pragma once

#include <warmjoint/estimate.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "identification/fit/fit.h"

namespace warmjoint {

/// A parameter of the law outside of its physical bound.
struct Excess {
  const Unknown& parameter;
  std::optional<std::array<double, 2>> interval95;
  double bound = 0;
  bool below = false;   // the bound; else above
  bool beyond = false;  // with its whole 95 % interval
};

/// The sentence about parameters that were set to their bounds.
std::string ExplainHeld(const std::vector<Excess>& held);
/// The sentence about a law that does not describe the data: by one of its parameters, or since friction rises from rest.
std::string ExplainExcess(const Excess& excess, const Fit& fit);
std::string ExplainRiseFromRest(const Fit& fit);

/// Columns that the motion does not distinguish.
struct MixedColumns {
  std::vector<std::string> names;      // of law and load
  std::optional<GravityKind> gravity;  // where it is one of them
  bool has_inertia = false;
};
/// The sentence about such columns, gravity or inertia among them. For columns of the law only there is Indistinct (fit_data.h).
std::string ExplainMixedColumns(const MixedColumns& mixed);

/// Samples at places that were passed in both directions.
struct PairedSamples {
  double share = 0;  // of all
  double range = 0;  // rad
};
/// The sentence about paired gravity that has too few such samples.
std::string ExplainFewPairs(const PairedSamples& found, const PairedSamples& needed);
inline constexpr const char* kSineOfLinearJoint =
    "gravity sincos needs an angle and the joint is linear; use gravity paired";
inline constexpr const char* kGravityWithoutPositions =
    "the log has no positions, and gravity depends on them; log them, or leave gravity out";
inline constexpr const char* kGravityWithoutSomePosition =
    "position is not finite throughout, and gravity depends on it; repair it";

// of friction that grows with the load
inline constexpr const char* kLoadIsUnknown =
    "load estimated needs the column load, or gravity sincos or paired, which tells what the joint "
    "carries; the log has no such column and gravity is none";
inline constexpr const char* kLoadDoesNotRest =
    "friction that grows with gravity does not come to rest after 40 rounds; use load none";
inline constexpr const char* kLoadBesideMaps =
    "load is estimated with a law without maps; use position none, or load none";

}  // namespace warmjoint
