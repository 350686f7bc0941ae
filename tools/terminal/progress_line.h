// One line on stderr on how far a long job is.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "tools/terminal/say.h"

namespace warmjoint {

/// On a terminal one line, cut to its width, drawn anew at most ten times a second and gone at the end; into a pipe or
/// a file a line every ten seconds, so that a log shows that the job lives. One thread at a time.
class ProgressLine {
 public:
  ProgressLine() = default;
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

/// What a command does now, for work that counts no steps: from the first second on a ProgressLine such as
/// "fitting energy-ml, 12 s", drawn by a thread of its own. While it lives, an interrupt ends the program as
/// ever, after one line that says so.
class Activity {
 public:
  explicit Activity(std::string words);
  ~Activity();
  Activity(const Activity&) = delete;
  Activity& operator=(const Activity&) = delete;

  /// What is done from here on.
  void Is(std::string words);

  /// Prints other words while the line is out of the way.
  void Aside(const std::function<void()>& print);

 private:
  void (*earlier_)(int) = nullptr;  // what an interrupt did before
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::string words_;
  ProgressLine line_;
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace warmjoint
