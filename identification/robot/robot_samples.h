// A robot's log in the form for fits of its joints: filtered without delay, differentiated, thinned, and where each joint clearly moves.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace warmjoint {

/// The settings by which a log of n joints is prepared.
struct RobotFilter {
  double cutoff = 10;  // Hz of the zero-phase low-pass that positions, torques and all columns pass
  int harmonics = 12;  // of the motor's turn, where a gear is given
};

/// Samples of the n motors of a robot (of its joints, where none is coupled).
struct RobotSamples {
  double step = 0;       // s, of the thinned samples
  Eigen::VectorXd time;  // [N] s
  Eigen::MatrixXd joint_position, joint_velocity,
      joint_acceleration;                            // [N x n] of the joints, for the rigid part
  Eigen::MatrixXd position, velocity, acceleration;  // [N x n] of the motors
  Eigen::MatrixXd torque;                            // [N x n]
  Eigen::MatrixXd sign;                              // [N x n] of the velocity, unfiltered
  /// [N x n] 1 where the joint moves in that direction, filtered
  Eigen::MatrixXd forwards, backwards;
  /// [N x 3n] exp(-(v / (share of the top speed))^2) sign(v), filtered; three of kSlowShares a joint
  Eigen::MatrixXd slow;
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>
      keep;                             // [N x n] away from rests, reversals and gaps
  Eigen::VectorXd top;                  // [n] speed, rad/s or m/s
  Eigen::VectorXd travel;               // [n] rad or m
  std::vector<Eigen::MatrixXd> ripple;  // [n] of [N x 4 harmonics], or [N x 0]
};

/// A recording with even steps of time.
struct RobotMotionLog {
  double step = 0;                                            // s
  Eigen::VectorXd time;                                       // [M]
  Eigen::MatrixXd position;                                   // [M x n] of the joints, rad or m
  Eigen::MatrixXd torque;                                     // [M x n] of the motors
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> logged;  // [M x n]
};

/// coupling: [n x n] C, the motors turn by C q. gears: [n] motor turns for each turn of what it drives; 0: no ripple is looked for.
/// Positions are low-passed and differentiated twice by central differences; a sample counts where the joint is faster than a fiftieth of its
/// top speed within 1 / cutoff on both sides: at a reversal under a servo a joint sticks, with a friction anywhere between both levels.
RobotSamples PrepareRobot(const RobotMotionLog& log, const Eigen::MatrixXd& coupling,
                          const Eigen::VectorXd& gears, const RobotFilter& filter);

}  // namespace warmjoint
