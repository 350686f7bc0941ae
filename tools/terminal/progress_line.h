// One line on stderr that tells how far a long job is.
#pragma once

#include <chrono>
#include <string>

#include "tools/terminal/page.h"

namespace warmjoint::inline tools {

/// On a terminal one line, cut to its width, drawn anew at most ten times a second and gone at the end; into a pipe or
/// a file a line every ten seconds, so that a log tells that the job lives. One thread at a time.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Whether it is time for another line; never with --quiet.
  bool Due() const;
  void Show(const std::string& words);
  /// Takes the line off a terminal, so that other words can stand there.
  void Clear();
  /// s since the beginning.
  double seconds() const;

 private:
  using Clock = std::chrono::steady_clock;

  bool terminal_ = PageOf(stderr).terminal;
  bool drawn_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

/// "45 s", "3 min 20 s", "2 h 5 min".
std::string DurationInWords(double seconds);

}  // namespace warmjoint::inline tools
