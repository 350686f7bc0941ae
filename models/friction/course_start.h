// What a joint remembers as a motion begins.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace warmjoint::inline models {

/// A change of E that no loss explains, as in a gap of the log.
struct EnergyJump {
  Eigen::Index sample = 0;
  double change = 0;  // N.m or N
};

/// What a joint remembers as a motion begins, and what else is known of E.
struct CourseStart {
  double energy = 0;                // E1, N.m or N
  double second_energy = 0;         // E2, N.m or N
  std::vector<EnergyJump> jumps{};  // of E1, their samples ascending
};

}  // namespace warmjoint::inline models
