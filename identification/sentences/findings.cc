#include "identification/sentences/findings.h"

#include <fmt/format.h>

namespace warmjoint {
namespace {

std::string OrElse(std::string_view other) {
  return fmt::format("; the log's one speed cannot distinguish that from {}", other);
}

}  // namespace

std::string NameOfPeriod(double period, std::string_view or_else) {
  return fmt::format("time (periodic, {:.3g} s{})", period, or_else);
}

std::string NameOfLag(double lag) {
  return fmt::format("the time since the last change of speed (the torque lags by some {:.1g} s)",
                     lag);
}

std::string NameOfMemory(double time) {
  return fmt::format("the speed of the last {:.2g} s (friction follows the speed late)", time);
}

std::string NameOfRipple(double period, std::optional<double> in_a_turn, JointKind joint,
                         std::string_view or_else) {
  return fmt::format("position (period {:.3g} {}{}{})", period, kPositionUnit.For(joint),
                     in_a_turn ? fmt::format(", {:.3g} a turn", *in_a_turn) : "", or_else);
}

std::string NameOfMotorRipple(double period, std::string_view or_else) {
  return fmt::format("motor angle (period {:.3g} rad{})", period, or_else);
}

std::string NameOfRippleBySpeed(std::string_view angle) { return fmt::format("speed x {}", angle); }

std::string OrElsePosition(double period, JointKind joint) {
  return OrElse(fmt::format("position, period {:.3g} {}", period, kPositionUnit.For(joint)));
}

std::string OrElseTime(double frequency) {
  return OrElse(fmt::format("time, {:.3g} Hz", frequency));
}

}  // namespace warmjoint
