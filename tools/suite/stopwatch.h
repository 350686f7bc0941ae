// How long something took.
#pragma once

#include <chrono>

namespace warmjoint {

class Stopwatch {
 public:
  /// Since it was made, s.
  double Seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace warmjoint
