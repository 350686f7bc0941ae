// A number that is fixed or drawn.
#pragma once

#include "models/foundation/random_stream.h"

namespace warmjoint::inline scenarios {

/// A fixed number, a uniform range, a normal, or a log-uniform range.
struct Distribution {
  enum class Kind { fixed, uniform, normal, log_uniform };
  Kind kind = Kind::fixed;
  double a = 0;  // value, lower bound or mean
  double b = 0;  // upper bound or standard deviation

  double Draw(RandomStream& random) const;

  bool operator==(const Distribution&) const = default;
};

}  // namespace warmjoint::inline scenarios
