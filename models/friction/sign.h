// The sign function of the friction laws.
#pragma once

namespace warmjoint {

/// -1, 0 or 1; sign(0) = 0, so a joint at rest has no sliding friction.
template <typename T>
constexpr int Sign(const T& value) {
  return (value > T(0)) - (value < T(0));
}

}  // namespace warmjoint
