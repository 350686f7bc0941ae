// How far a long job is.
#pragma once

#include <chrono>
#include <map>
#include <string>

namespace warmjoint::inline tools {

/// A line on stderr with rate, failures so far and time left, when stderr is a terminal; else
/// silent. One thread at a time.
class Progress {
 public:
  /// total: of things to do; already: of them done before.
  Progress(int total, int already);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Counts finished things; redraws at most ten times a second.
  void Add(int finished);
  void AddFailure(const std::string& status) { ++failures_[status]; }

  /// "37/50 realizations, 12.4/s, 1 s left, failures: not_converged 3".
  std::string Line(double seconds) const;

 private:
  using Clock = std::chrono::steady_clock;

  int total_;
  int already_;
  int finished_ = 0;
  std::map<std::string, int> failures_;
  bool shown_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point drawn_{};
};

}  // namespace warmjoint::inline tools
