// What is mended of a log: clocks that tick coarsely, and positions that a sensor reports within one turn.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace warmjoint {

/// What was made of a clock.
struct MendedClock {
  std::vector<bool>
      keep;  // [N] false for few samples whose stamp is that of the one before, or earlier; empty: all
  std::string note;  // what was done; empty where nothing was
};

/// Makes time increase where a clock is coarse or made a slip. Stamps that repeat more often than once in 100 samples are ticks,
/// within which samples are spread evenly; fewer that repeat or step back are to be left out. Leaves all other clocks as they
/// are. time: [N] s, changed in place; position: [N], by which rows of several joints at one stamp
/// are told from ticks.
MendedClock MendClock(const Eigen::VectorXd& position, Eigen::VectorXd& time);

/// Undoes the jumps in a position whose sensor starts again after `range`, rad or m, and returns their number. A range
/// that is given counts however far the positions reach: each jump of more than half of it is one. range 0: after a
/// whole turn of a rotary joint. It is then taken as wrapped when it stays within one turn and jumps by
/// more than half a turn; where a velocity is recorded, a jump is undone only when that brings the
/// step nearer to v h. A jump at a gap of the log (LongestStep) is none by itself, since in it the joint may have
/// moved anywhere; where the sensor wraps elsewhere, the nearest place is taken. Without a velocity the joint must
/// move less than half a range between samples. time: [N] s; velocity: [N] rad/s or m/s, or [0] where not recorded;
/// position: [N] rad or m, changed in place.
int UndoJumps(const Eigen::VectorXd& time, const Eigen::VectorXd& velocity, double range,
              Eigen::VectorXd& position);

}  // namespace warmjoint
