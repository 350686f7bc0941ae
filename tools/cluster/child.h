// Programs that this one starts, watches and ends.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace warmjoint::inline tools {

/// Where a child works and what becomes of its words.
struct ChildPlace {
  std::filesystem::path directory;  // empty: this program's
  std::filesystem::path words;      // file for all that it says; empty: this program's
};

/// A running program, which dies with this one. One thread starts and watches it.
class Child {
 public:
  /// arguments: the first is the program's file. Throws runtime_error where none can be started.
  Child(const std::vector<std::string>& arguments, const ChildPlace& place);
  /// Kills what still runs.
  ~Child();
  Child(Child&& other) noexcept;
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  Child& operator=(Child&&) = delete;

  /// Exit status once it has ended, 128 + signal where one ended it.
  std::optional<int> Poll();
  void Signal(int signal) const;
  pid_t pid() const { return pid_; }

 private:
  pid_t pid_ = -1;
  std::optional<int> status_;
};

/// What a program answered.
struct Captured {
  int status = 127;  // as a shell has it; 127: it cannot be started
  std::string out;
  std::string err;
};

/// Runs a program of PATH to its end and takes its words.
Captured Capture(const std::vector<std::string>& arguments);

}  // namespace warmjoint::inline tools
