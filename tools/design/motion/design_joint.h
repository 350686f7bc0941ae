// The steps of a design of one joint, which those of a robot share.
#pragma once

#include <warmjoint/design.h>
#include <warmjoint/prepared_log.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/design/motion_plan.h"
#include "tools/design/possible_joint.h"

namespace warmjoint {

using WatchDesign = std::function<void(const std::string& words)>;

/// A joint of which it is said what is expected.
struct ExpectedJoint {
  DesignSettings settings;            // with a noise, and a fastest speed within the torque
  std::vector<Friction> frictions{};  // draws of the prior, the middle first
  std::vector<PossibleJoint> joints{};
  std::optional<PreparedLog> after{};

  /// The largest friction at a speed, N.m or N.
  double Level(double speed) const;
};

/// Throws BadInput as DesignMotion does.
ExpectedJoint Expect(const DesignSettings& settings, const std::optional<PreparedLog>& after);

/// The speeds whose log tells the most.
std::vector<SpeedBlock> BestBlocks(const ExpectedJoint& expected, const WatchDesign& watch);

/// What the log of a motion will tell.
Design Foretold(const ExpectedJoint& expected, std::vector<MotionKnot> knots,
                const WatchDesign& watch);

}  // namespace warmjoint
