// Noise and resolution of the positions of a log.
#pragma once

#include <Eigen/Core>

namespace warmjoint {

/// Noise and resolution of the positions of one recording.
struct PositionNoise {
  double resolution = 0;  // step of a quantised position, rad or m; 0 where it is not quantised
  double deviation = 0;   // standard deviation, rad or m
  double reach = 0;       // how far a position may lie from where the joint was, rad or m
};

/// Step of a quantised position: the common divisor of its changes by Euclid's algorithm, of which each is a multiple to
/// 5 %. With a fine rounding of a fast motion, no change is a single step. 0 where there is none, or all are the same
/// multiple. position: [N] rad or m, within one recording.
double StepOfPosition(const Eigen::VectorXd& position);

/// deviation s: median of |third differences| / (0.6745 sqrt(20)), which motion at a constant speed
/// and most ramps do not touch; but for those that are 0 where q is: some drives log one position all through a rest. Where s
/// <= 1.7 q / sqrt(12), q the resolution, rounding is all the noise there is: a line through the middle of all counts passes
/// within q / 2 of each, reach is 0.51 q and the deviation q / sqrt(12). Else reach is 4.5 s: one sample in 150,000 lies
/// further off by chance. Both are at least 1e-9 of the range, for numbers that are rounded in a file.
/// position: [N] rad or m, within one recording.
PositionNoise MeasurePositionNoise(const Eigen::VectorXd& position);
/// The same where the resolution is known.
PositionNoise MeasurePositionNoise(const Eigen::VectorXd& position, double resolution);

/// Positions less the first, counted in steps.
struct RelativePosition {
  Eigen::VectorXd steps;  // [N] whole numbers where the position is quantised
  double step = 1;        // its resolution, rad or m; 1 where it is not quantised
  double resolution = 0;  // the same; 0 where it is not quantised
};

/// Positions relative to the first one, in steps, so that results do not depend on the sensor's zero. position: [N]
/// rad or m, within one recording.
RelativePosition FromFirst(const Eigen::VectorXd& position);

}  // namespace warmjoint
