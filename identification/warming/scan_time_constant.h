// A start for the warm-up without any guess: variable projection over log(tau).
#pragma once

#include <Eigen/Core>

#include "identification/forward/closed_loop.h"

namespace warmjoint {

/// The longest time constant that is scanned, in durations of the recording.
inline constexpr double kScannedBeyond = 5;

/// Law parameters and warming to start from.
struct InitialGuess {
  Eigen::VectorXd parameters;  // [d] of the loop's columns
  Thermal thermal;
  double shortest = 0;  // range of time constants that was scanned, s
  double longest = 0;
};

/// With the loss taken from the measured torque, W = tau v, the level is linear in all but tau:
///     sign(v) tau_measured = g p + k x,  x = W filtered by 1/(1 + s tau).
/// Sixteen values of tau, even in log(tau), are tried; for each the rest is a linear solve (Golub
/// and Pereyra 1973); a parabola through the best and its neighbours refines it. Samples are taken
/// together in at most a thousand blocks, since a start need not be exact.
/// torque: [N] N.m or N; kept: [N] 1 where a sample takes part in fits, else 0.
InitialGuess ScanTimeConstant(const ClosedLoop& loop, const Eigen::VectorXd& torque,
                              const Eigen::VectorXd& kept);

/// Columns of a rigid part, which make no heat, and their values in a fit without warming.
struct RigidGuess {
  const Eigen::MatrixXd& columns;  // [N x q]
  Eigen::VectorXd values;          // [q]
};

/// The same where the last columns of the loop are those of a rigid part: it is subtracted from the loss, and what it then has in
/// error is scanned together with the law.
InitialGuess ScanBeside(const RigidGuess& rigid, const ClosedLoop& loop,
                        const Eigen::VectorXd& torque, const Eigen::VectorXd& kept);

}  // namespace warmjoint
