// What a command is at, for those who wait for it.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "tools/terminal/progress_line.h"

namespace warmjoint::inline tools {

/// From the first second on, tells on stderr what is being done and for how long: "fitting energy-ml,
/// 12 s". A thread of its own draws it as ProgressLine does, so that the work needs no steps. While it
/// lives, an interrupt ends the program as ever, after one line that says so.
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
  void Draw();

  void (*earlier_)(int) = nullptr;  // what an interrupt did before
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::string words_;
  ProgressLine line_;
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace warmjoint::inline tools
