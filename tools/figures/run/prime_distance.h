// Which realizations of a long run are looked at.
#pragma once

#include <cstdint>

namespace warmjoint::figures {

/// The smallest distance, 1 or a prime, at which at most about `most` of `all` are taken: realizations at
/// such a distance share no period that a run may have.
inline int PrimeDistance(std::int64_t all, std::int64_t most) {
  const auto divided = [](std::int64_t n) {
    for (std::int64_t d = 2; d * d <= n; ++d) {
      if (n % d == 0) return true;
    }
    return false;
  };
  std::int64_t distance = (all + most - 1) / most;
  while (divided(distance)) ++distance;
  return static_cast<int>(distance > 1 ? distance : 1);
}

}  // namespace warmjoint::figures
