// Work that parts do not share, on all processors.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace warmjoint {

/// Does it for 0, ..., count - 1, several at once; what one throws is thrown when all have ended.
template <typename Work>
void ForEachAtOnce(Eigen::Index count, const Work& work) {
  std::atomic<Eigen::Index> next{0};
  std::exception_ptr thrown;
  std::mutex one;
  const auto run = [&] {
    for (Eigen::Index i; (i = next++) < count;) {
      try {
        work(i);
      } catch (...) {
        const std::lock_guard lock(one);
        if (!thrown) thrown = std::current_exception();
      }
    }
  };
  {
    std::vector<std::jthread> others;
    const Eigen::Index threads =
        std::clamp<Eigen::Index>(std::thread::hardware_concurrency(), 1, 8);
    for (Eigen::Index i = 1; i < std::min(threads, count); ++i) others.emplace_back(run);
    run();
  }
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace warmjoint
