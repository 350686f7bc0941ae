// A number that is fixed or drawn.
#pragma once

#include <array>
#include <span>

#include "models/foundation/node.h"
#include "models/foundation/random_stream.h"

namespace warmjoint {

/// A fixed number, a uniform range, a normal, or a log-uniform range.
struct Distribution {
  enum class Kind { fixed, uniform, normal, log_uniform };
  Kind kind = Kind::fixed;
  double a = 0;  // value, lower bound or mean
  double b = 0;  // upper bound or standard deviation

  double Draw(RandomStream& random) const;
};

inline std::span<const Word<Distribution::Kind>> WordsOf(Distribution::Kind) {
  using Kind = Distribution::Kind;
  static constexpr std::array words{Word{"uniform", Kind::uniform},
                                    Word{"log_uniform", Kind::log_uniform},
                                    Word{"normal", Kind::normal}};
  return words;
}

/// Whether the value is a map with the one key uniform, log_uniform or normal.
bool IsDistribution(const Node& node);

/// A number, {uniform: [lower, upper]}, {log_uniform: [lower, upper]} or {normal: [mean, standard
/// deviation]}; the bounds hold for each number but the deviation.
void ReadValue(const Node& node, Distribution* value, const FieldInfo& info);
Tree WriteValue(const Distribution& value);

}  // namespace warmjoint
