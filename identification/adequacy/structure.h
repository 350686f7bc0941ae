// What a fit has left in its residual.
#pragma once

#include <Eigen/Core>
#include <string>

namespace warmjoint::inline identification {

/// On what a residual depends.
enum class Dependence {
  time,
  energy,
  initial_energy,
  speed,
  speed_by_energy,  // a slope that warms
  direction,
  lag,  // of the torque behind the velocity
  load,
  temperature,
  position,
  position_by_energy,  // a map that fades or grows as the joint warms
  motor_angle
};

/// Structure that stands out of the noise: a z-score (uncertainty/tails.h) of at least kCertain.
struct Structure {
  Dependence on = Dependence::time;
  double explained = 0;  // squares of the residual's samples that it explains, less the noise's
  double merit = 0;      // the same less ln(m) times the noise's variance for each of its features,
                         // as BIC has it: what needs fewer features says more
  double deviations = 0;  // from chance, a z-score
  double period = 0;      // of a ripple, in the unit of the angle; 0: none. Of a lag: the lag, s
  double alike = 0;       // share of an angle's part that acts alike in both directions of motion
  Eigen::VectorXd
      moves;  // [p] change of the fit's parameters when the structure joins it; or empty
  Eigen::VectorXd move_deviations;  // [p] standard deviations of `moves`
};

/// By chance one block in 1.7 million exceeds this, p = 5.7e-7; of a few hundred frequencies one in
/// some ten thousand recordings.
inline constexpr double kCertain = 5;

/// The same for what explains most of a residual's variance, as noise of few waves hardly does:
/// p = 4.7e-4.
inline constexpr double kCertainMost = 3.5;

/// The same for a single coefficient that is asked for by name: one recording in 2150 exceeds it
/// by chance, p = 4.7e-4.
inline constexpr double kCertainNamed = 3.5;

/// The same for E(0): one cold start in 80 exceeds it, p = 0.0124. A start that is warm by a few deviations
/// moves all else far beyond its interval.
inline constexpr double kCertainStart = 2.5;

/// From here on structure that is there counts as moving a parameter.
inline constexpr double kCertainMove = 3;

/// Parts of a recording that count as independent of each other: noise may be coloured within them.
inline constexpr Eigen::Index kParts = 32;

}  // namespace warmjoint::inline identification
