#include <fmt/format.h>
#include <mujoco/mjxmacro.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string_view>

#include "tests/public_models/robot_trial.h"

namespace warmjoint::test {
namespace {

/// Whether attaching may change the array of that name.
bool MayChange(std::string_view name, FrictionForm form) {
  const auto is_one = [&](const auto& others) {
    return std::find(others.begin(), others.end(), name) != others.end();
  };
  constexpr std::array always{
      std::string_view("dof_damping"),      std::string_view("dof_dampingpoly"),
      std::string_view("dof_frictionloss"), std::string_view("paths"),
      std::string_view("actuator_damping"), std::string_view("actuator_dampingpoly"),
      std::string_view("jnt_actuatorid"),   std::string_view("body_plugin")};
  constexpr std::array by_actuators{
      std::string_view("key_act"),           std::string_view("key_ctrl"),
      std::string_view("jnt_actfrclimited"), std::string_view("jnt_actfrcrange"),
      std::string_view("jnt_actuatorid"),    std::string_view("tree_sleep_policy")};
  if (name.starts_with("plugin") || name.starts_with("name") || name.ends_with("pathadr"))
    return true;
  if (name == "tex_contenttypeadr" || is_one(always)) return true;
  return form == FrictionForm::actuator && (name.starts_with("actuator_") || is_one(by_actuators));
}

/// Unit vectors, which the compiler normalises anew; the last bit may move.
bool SameUnitVectors(std::string_view name, const void* a, const void* b, size_t size) {
  if (name != "jnt_axis") return false;
  const auto* x = static_cast<const mjtNum*>(a);
  const auto* y = static_cast<const mjtNum*>(b);
  return std::equal(x, x + size / sizeof(mjtNum), y,
                    [](mjtNum one, mjtNum other) { return std::abs(one - other) < 2.3e-16; });
}

}  // namespace

int CountChanges(const mjModel* before, const mjModel* after, FrictionForm form) {
  int changes = 0;
  const auto compare = [&](const char* name, const void* a, const void* b, size_t size_a,
                           size_t size_b) {
    if (MayChange(name, form)) return;
    if (size_a == size_b && (size_a == 0 || std::memcmp(a, b, size_a) == 0)) return;
    if (size_a == size_b && SameUnitVectors(name, a, b, size_a)) return;
    fmt::print(stderr, "  changed: {}\n", name);
    ++changes;
  };
#undef MJ_M
#define MJ_M(n) m->n
#define X(type, name, nr, nc)                                                                  \
  {                                                                                            \
    const mjModel* m = before;                                                                 \
    const size_t size_a = sizeof(type) * static_cast<size_t>(m->nr) * static_cast<size_t>(nc); \
    m = after;                                                                                 \
    const size_t size_b = sizeof(type) * static_cast<size_t>(m->nr) * static_cast<size_t>(nc); \
    compare(#name, before->name, after->name, size_a, size_b);                                 \
  }
#define XNV X
  MJMODEL_POINTERS
#undef X
#undef XNV
#undef MJ_M
#define MJ_M(n) n
  return changes;
}

}  // namespace warmjoint::test
