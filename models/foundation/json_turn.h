// The turn of a thread to read or write JSON.
#pragma once

#include <mutex>

namespace warmjoint {

/// Held while nlohmann's parser or writer works on a thread of several: both ask localeconv() for the decimal
/// point, which glibc calls unsafe for threads.
inline std::unique_lock<std::mutex> JsonTurn() {
  static std::mutex turn;
  return std::unique_lock(turn);
}

}  // namespace warmjoint
