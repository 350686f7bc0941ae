// Finished realizations on their way from the workers to the one writer.
#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <utility>
#include <vector>

#include "tools/store/result.h"

namespace warmjoint::inline tools {

/// Workers put, the writer takes. A worker that dies hands its exception over.
class FinishedQueue {
 public:
  explicit FinishedQueue(int workers) : workers_(workers) {}

  void Put(Realization realization) {
    const std::lock_guard lock(mutex_);
    finished_.push_back(std::move(realization));
  }

  /// A worker has ended; error: what ended it, or nullptr.
  void Leave(std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    --workers_;
    if (error) error_ = error;
    changed_.notify_one();
  }

  /// All that finished within `patience`, or at once when the last worker leaves.
  std::vector<Realization> Take(std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, patience, [this] { return workers_ == 0; });
    return std::exchange(finished_, {});
  }

  /// Whether all workers have left and everything was taken. Throws what ended a worker.
  bool Done() {
    const std::lock_guard lock(mutex_);
    if (workers_ == 0 && error_) std::rethrow_exception(error_);
    return workers_ == 0 && finished_.empty();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Realization> finished_;
  std::exception_ptr error_;
  int workers_;
};

}  // namespace warmjoint::inline tools
