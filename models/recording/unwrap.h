// Positions that a sensor reports within one turn.
#pragma once

#include <Eigen/Core>

namespace warmjoint {

/// Undoes the jumps of a whole turn in the position of a rotary joint, so that it goes on where the
/// sensor starts its turn again. It is taken as wrapped when it stays within one turn and jumps by
/// more than half a turn; where a velocity is recorded, a jump is undone only when that brings the
/// step nearer to v h. A jump at a gap of the log (LongestStep) is none by itself, since in it the joint may have
/// moved anywhere; where the sensor wraps elsewhere, the nearest place is taken. Without a velocity the joint must move less than half a turn between
/// samples. time: [N] s; velocity: [N] rad/s or [0] where not recorded; position: [N] rad, changed
/// in place. Returns the number of jumps undone.
int UnwrapTurns(const Eigen::VectorXd& time, const Eigen::VectorXd& velocity,
                Eigen::VectorXd& position);

/// The same for a sensor that starts again after `range`, rad or m, however far the positions reach:
/// the range is given, so that each jump of more than half of it is one.
int UnwrapRange(const Eigen::VectorXd& time, const Eigen::VectorXd& velocity, double range,
                Eigen::VectorXd& position);

}  // namespace warmjoint
