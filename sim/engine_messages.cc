#include "sim/engine_messages.h"

#include <mujoco/mujoco.h>

#include <cstdio>

namespace warmjoint {
namespace {

thread_local std::vector<std::string>* collector = nullptr;

void Collect(const char* message) {
  if (collector) {
    collector->emplace_back(message);
  } else {
    std::fprintf(stderr, "warning: %s\n", message);
  }
}

}  // namespace

EngineMessages::EngineMessages() : outer_(collector) {
  static const bool installed = [] {
    mju_user_warning = Collect;
    return true;
  }();
  static_cast<void>(installed);
  collector = &messages_;
}

EngineMessages::~EngineMessages() { collector = outer_; }

}  // namespace warmjoint
