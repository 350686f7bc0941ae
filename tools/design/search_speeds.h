// The search for a sequence of speeds and rests.
#pragma once

#include <functional>
#include <vector>

#include "tools/design/motion_plan.h"
#include "tools/design/possible_joint.h"

namespace warmjoint {

/// What is searched for, and where.
struct SpeedSearch {
  const DesignSettings& settings;
  const std::vector<PossibleJoint>& joints;   // that are averaged over
  std::function<void(double share)> watch{};  // is told how much is done; may throw
};

/// The length of a cell that resolves a motion and the joints' warming, s.
double CellLength(const DesignSettings& settings, const std::vector<PossibleJoint>& joints);

/// One cost for each joint.
std::vector<AimCost> CostsOf(const SpeedSearch& search);

/// The cost of a motion, for one joint.
double CostOf(const std::vector<MotionKnot>& knots, const SpeedSearch& search, const AimCost& cost,
              const PossibleJoint& joint);

/// Exchange: groups of neighbouring blocks take each of some speeds and a rest in turn, and keep the one at which the mean cost is least;
/// groups become finer. It begins at random speeds, several times. Every tenth block surveys the speeds between,
/// unless one parameter is aimed at, or a friction with a curve. Returns the best.
std::vector<SpeedBlock> SearchSpeeds(const SpeedSearch& search);

/// Speeds drawn uniformly between the limits, a stroke each.
std::vector<SpeedBlock> RandomSpeeds(const DesignSettings& settings, std::uint64_t draw);

/// Ten even speeds up and down again, a stroke each.
std::vector<SpeedBlock> LadderOfSpeeds(const DesignSettings& settings);

}  // namespace warmjoint
