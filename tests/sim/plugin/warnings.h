// The engine's warnings, for the plugin's tests.
#pragma once

#include <mujoco/mujoco.h>

#include <string>

namespace warmjoint::test {

/// All warnings of the engine, while it lives.
class Warnings {
 public:
  Warnings() {
    text() = "", mju_user_warning = [](const char* message) { text() += message; };
  }
  ~Warnings() { mju_user_warning = nullptr; }
  static std::string& text() {
    static std::string all;
    return all;
  }
};

}  // namespace warmjoint::test
