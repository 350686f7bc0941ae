// One line on stderr that tells how far a long job is.
#pragma once

#include <chrono>
#include <string>

namespace warmjoint::inline tools {

/// On a terminal one line, drawn anew at most ten times a second and gone at the end; into a pipe or a file a line
/// every ten seconds, so that a log tells that the job lives. One thread at a time.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Whether it is time for another line.
  bool Due() const;
  void Show(const std::string& words);
  /// s since the beginning.
  double seconds() const;

 private:
  using Clock = std::chrono::steady_clock;

  bool terminal_;
  bool drawn_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

/// "45 s", "3 min 20 s", "2 h 5 min".
std::string DurationInWords(double seconds);

}  // namespace warmjoint::inline tools
