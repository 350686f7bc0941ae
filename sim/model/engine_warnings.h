// What MuJoCo warns of: it prints that on the terminal and appends it to MUJOCO_LOG.TXT in the working folder, unless someone takes it.
#pragma once

#include <functional>
#include <set>
#include <string>

namespace warmjoint {

/// Takes the warnings of MuJoCo from all threads while it lives: nothing is printed and no file is written. Several may live at
/// once; each takes all warnings, and the last that ends gives the handler back that was there before the first.
class EngineWarnings {
 public:
  /// Gets a sentence "MuJoCo: ..." of each kind of warning, one at a time; warnings that differ in numbers alone are of one kind.
  using Take = std::function<void(const std::string&)>;

  explicit EngineWarnings(Take take);
  ~EngineWarnings();
  EngineWarnings(const EngineWarnings&) = delete;
  EngineWarnings& operator=(const EngineWarnings&) = delete;

 private:
  static void Deliver(const char* warning);

  Take take_;
  std::set<std::string> kinds_;  // those that were taken, without their numbers
};

}  // namespace warmjoint
