// How far a long job is.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "tools/terminal/progress_line.h"

namespace warmjoint {

/// Realizations with their rate, failures so far and time left, as ProgressLine shows them. One thread at a time.
class Progress {
 public:
  /// total: of things to do; already: of them done before, with so many failures of each status.
  Progress(int total, int already, std::map<std::string, int> failures = {})
      : total_(total), already_(already), failures_(std::move(failures)) {}

  /// Counts finished things, 0 too: time may have come for a line.
  void Add(int finished);
  void AddFailure(const std::string& status) { ++failures_[status]; }

  /// "37/50 realizations, 12.4/s, 1 s left, failures: not_converged 3".
  std::string Line(double seconds) const;

 private:
  int total_;
  int already_;
  int finished_ = 0;
  std::map<std::string, int> failures_;
  ProgressLine line_;
};

}  // namespace warmjoint
