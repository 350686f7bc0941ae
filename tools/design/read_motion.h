// A motion that a file gives without a torque.
#pragma once

#include <optional>
#include <string>

#include "scenarios/motion.h"

namespace warmjoint {

/// A motion with how long it lasts.
struct TimedMotion {
  Motion motion;
  double duration = 0;  // s
};

/// The motion of a table of text with columns time (s), position and velocity (SI) and no torque, as motion.csv of a design: its rows
/// are corners, between which the velocity is linear; nothing for any other file. Throws BadInput for rows whose times do not ascend.
std::optional<TimedMotion> ReadMotion(const std::string& file);

}  // namespace warmjoint
