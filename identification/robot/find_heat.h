// Whether a joint's friction changes with the heat of its own losses, before a time constant is fitted.
#pragma once

namespace warmjoint {

struct JointColumns;
struct JointFit;
struct JointQuestion;

/// The best of a scan over time constants.
struct HeatGuess {
  bool warms = false;        // friction falls, beyond chance over all time constants and joints
  double deviations = 0;     // of the gain at the best time constant
  double gain = 0;           // N.m/W or N/W
  double time_constant = 1;  // s
  double limit = 0;          // deviations below 0 from which it warms
  double shortest = 0;       // s, of the time constants that were tried
};

/// The gain of E by the losses of the cold fit, by least squares together with all its columns, for eight time constants up to the log's
/// length, from a thirtieth of it, ten periods of the motion or 20 s on; its error is by blocks of time, its limit by Student's t for eight tries on each joint of the robot.
HeatGuess FindHeat(const JointColumns& columns, const JointFit& cold,
                   const JointQuestion& question);

}  // namespace warmjoint
