// How long the torque takes to settle at a change of speed.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/recording.h>

#include <Eigen/Core>

namespace warmjoint {

inline Settling operator+(const Settling& one, const Settling& more) {
  return {one.after + more.after, one.before + more.before};
}
inline Settling operator*(const Settling& one, double share) {
  return {share * one.after, share * one.before};
}

/// The settling time that the residual of a fit shows; 0 where it shows none, or no end of it within a
/// quarter of a typical segment.
///
/// Means z of the residual over runs that grow with the time from the change are compared with those as long from the
/// segment's middle on, r, and with those as far from the change on its other side, p, where the joint was at the same
/// place: z is farther from 0 than either, z^2 > r^2 and z^2 > p^2, or has the sign s of the change of speed,
/// as neither r nor a force or a friction of the place have: s z > s r, s p, -s p, or all the other way round. Each is a
/// sum S of terms over the segments whose signs are chance alone where the torque has settled, so that
///     P(|S| > x sqrt(sum of squares)) <= 2 exp(-x^2 / 2)
/// whatever their distribution (Hoeffding 1963). Where both sides have not settled, the worse one hides the other, which
/// is seen after the worse one was left out. used: the n of N samples that count; time: [N] s; residual: [n] N.m or N
Settling SettlingTime(const Selection& used, const Eigen::VectorXd& time,
                      const Eigen::VectorXd& residual);

/// Whether a torque may settle in that way: the unsettled ends of a typical segment together are at most half of it, so that as
/// much settled torque is left. Why: a torque that changes throughout the segments looks settled about its extremes. used: all
/// samples; time: [N] s
bool MaySettle(const Settling& settling, const Selection& used, const Eigen::VectorXd& time);

/// The share of a settling time within which the residual shows it beyond chance. Why: after that a run follows that is half as
/// long as all before, in which what is left fades away.
inline constexpr double kShownToSettle = 2.0 / 3;

/// A selection without the samples of each segment that are nearer to its ends than `settling`. time: [N] s
Selection WithoutSettling(Selection selection, const Eigen::VectorXd& time,
                          const Settling& settling);

}  // namespace warmjoint
