// What MuJoCo says while it works, kept instead of printed.
#pragma once

#include <string>
#include <vector>

namespace warmjoint {

/// Collects the warnings that MuJoCo, and plugins through it, give on this thread while the object
/// lives. Outside of any such object warnings go to stderr.
class EngineMessages {
 public:
  EngineMessages();
  ~EngineMessages();
  EngineMessages(const EngineMessages&) = delete;
  EngineMessages& operator=(const EngineMessages&) = delete;

  /// The messages so far, in their order.
  const std::vector<std::string>& messages() const { return messages_; }

 private:
  std::vector<std::string> messages_;
  std::vector<std::string>* outer_;  // collector of the enclosing object, or nullptr
};

}  // namespace warmjoint
