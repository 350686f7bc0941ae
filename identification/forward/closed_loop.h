// Warm friction over a recorded motion: the loop that Eqs. (19)-(22) close, and its derivatives.
#pragma once

#include <warmjoint/friction.h>
#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <optional>

#include "models/friction/intervals.h"

namespace warmjoint {

/// The response of the loop to one set of parameters.
struct LoopResponse {
  Eigen::VectorXd force;   // [N] F, Eq. (20), N.m or N
  Eigen::VectorXd loss;    // [N] W, Eq. (19), W
  Eigen::VectorXd energy;  // [N] E, Eq. (22), N.m or N
  /// First sample where friction drives the joint instead of braking it (E < -Fn sign v). From there on the
  /// energy that friction gives would count as heat, so that neither response nor derivatives mean anything.
  std::optional<Eigen::Index> first_driving;
};

/// The state at the end of the loop, or of a stretch of it.
struct LoopEnd {
  double energy = 0;       // E at the last sample, or at the one after the stretch, N.m or N
  Eigen::VectorXd slopes;  // [d + 3 + J] dE/d(p, k, log tau, E0, jumps)
};

/// Columns of a law along the samples from the first on, and those of its losses; empty: the same. Both [m x d].
struct LoopColumns {
  Eigen::Index first = 0;
  Eigen::MatrixXd law;
  Eigen::MatrixXd loss{};
};

/// The loop E -> F -> W -> E over N samples of a velocity, for a law that is linear in its d
/// parameters p. In its domain (F v >= 0) the loop is linear in E with the pole
/// lambda = te + ke |v|: written with the level a = F sign(v) = g p + E, g = sign(v) dFn/dp,
///     E[n+1] = te E[n] + ke |v[n]| a[n],
/// so that the derivatives S of E by all parameters share lambda:
///     p:  S[n+1] = lambda S[n] + ke |v| g          k:        lambda S[n] + (1 - te) |v| a
///     E0: S[n+1] = lambda S[n], S[0] = 1           log tau:  lambda S[n] + te h/tau (E - k |v| a)
/// Where losses have levels of their own, a and g in those of k|v| a and k|v| g are theirs.
/// Samples at rest have W = 0 and keep cooling. With uneven sampling each interval is exact.
/// Where E jumps by b at a sample (WithJumps): b: S = 0 before, 1 there, then lambda S[n].
class ClosedLoop {
 public:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// columns: [N x d] dFn/dp (LawColumns); time: [N] s; velocity: [N] rad/s or m/s; starts: samples
  /// at which the joint is cold again.
  ClosedLoop(const Eigen::VectorXd& time, const Eigen::VectorXd& velocity,
             const Eigen::MatrixXd& columns, const std::vector<Eigen::Index>& starts = {});

  /// parameters: [d] of the law; initial_energy: E(0), N.m or N.
  /// jumps: [J] N.m or N, of E at the samples of WithJumps.
  LoopResponse Simulate(const Eigen::VectorXd& parameters, const Thermal& thermal,
                        double initial_energy = 0, const Eigen::VectorXd& jumps = {}) const;

  /// dF/d(p, k, tau, E0, jumps): [N x (d + 3 + J)], exact.
  Eigen::MatrixXd Jacobian(const Eigen::VectorXd& parameters, const Thermal& thermal,
                           double initial_energy = 0, const Eigen::VectorXd& jumps = {}) const;

  /// dF/d(p, k, log tau, E0, jumps) along a stretch, [m x (d + 3 + J)], of a law with other columns than the loop's, which
  /// are not read. at: E and its derivatives at the first of its samples, led on to the sample after it.
  Rows SlopesAlong(const LoopColumns& columns, const Eigen::VectorXd& parameters,
                   const Thermal& thermal, const Eigen::VectorXd& jumps, LoopEnd& at) const;

  /// E at the last sample, and its exact derivatives there.
  LoopEnd End(const Eigen::VectorXd& parameters, const Thermal& thermal, double initial_energy = 0,
              const Eigen::VectorXd& jumps = {}) const;

  /// Along a recording. Where it has mean speeds, these make the losses, with loss_columns, which are
  /// `columns` at its loss velocity; empty: the same. Both [N x d].
  static ClosedLoop Along(const LogSamples& measurements, const Eigen::MatrixXd& columns,
                          const Eigen::MatrixXd& loss_columns = {});

  /// The same loop whose E jumps at samples, ascending: [J]
  ClosedLoop WithJumps(std::vector<Eigen::Index> samples) const;

  Eigen::Index size() const { return speed_.size(); }
  const Eigen::VectorXd& speed() const { return speed_; }  // [N] of the losses, |v|, rad/s or m/s
  const Eigen::VectorXd& direction() const { return direction_; }  // [N] sign(v)
  const Rows& levels() const { return levels_; }                   // [N x d] g
  const Rows& loss_levels() const {                                // [N x d] g of the losses
    return loss_levels_.size() > 0 ? loss_levels_ : levels_;
  }
  const Intervals& intervals() const { return intervals_; }
  const std::vector<Eigen::Index>& jumps() const { return jumps_; }  // [J] samples

 private:
  Rows Signed(const Eigen::MatrixXd& columns, Eigen::Index first = 0) const;

  Eigen::VectorXd speed_;
  Eigen::VectorXd direction_;
  Rows levels_;
  Rows loss_levels_;  // empty: levels_
  Intervals intervals_;
  std::vector<Eigen::Index> jumps_;
};

/// Derivatives by the discrete pair from those by the continuous one: columns k and tau (the last
/// three are k, tau, E0) become ke and te. h: the even sampling interval, s.
Eigen::MatrixXd ByDiscretePair(const Eigen::MatrixXd& jacobian, const Thermal& thermal, double h);

}  // namespace warmjoint
