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

/// Changes of E at samples, which no logged loss explains.
struct EnergyJumps {
  std::vector<Eigen::Index> samples{};  // [J] ascending
  Eigen::VectorXd values{};             // [J] N.m or N
};

/// The loop E -> F -> W -> E over N samples of a velocity, for a law that is linear in its d
/// parameters p. In its domain (F v >= 0) the loop is linear in E with the pole
/// lambda = te + ke |v|: written with the level a = F sign(v) = g p + E, g = sign(v) dFn/dp,
///     E[n+1] = te E[n] + ke |v[n]| a[n].
/// Where losses have levels of their own, a is theirs. Samples at rest have W = 0 and keep cooling. With uneven sampling each
/// interval is exact. Its derivatives: model/heat_loop.h.
class ClosedLoop {
 public:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// columns: [N x d] dFn/dp (LawColumns); time: [N] s; velocity: [N] rad/s or m/s; starts: samples
  /// at which the joint is cold again.
  ClosedLoop(const Eigen::VectorXd& time, const Eigen::VectorXd& velocity,
             const Eigen::MatrixXd& columns, const std::vector<Eigen::Index>& starts = {});

  /// parameters: [d] of the law; initial_energy: E(0), N.m or N.
  LoopResponse Simulate(const Eigen::VectorXd& parameters, const Thermal& thermal,
                        double initial_energy = 0, const EnergyJumps& jumps = {}) const;

  /// Along a recording. Where it has mean speeds, these make the losses, with loss_columns, which are
  /// `columns` at its loss velocity; empty: the same. Both [N x d].
  static ClosedLoop Along(const LogSamples& measurements, const Eigen::MatrixXd& columns,
                          const Eigen::MatrixXd& loss_columns = {});

  Eigen::Index size() const { return speed_.size(); }
  const Eigen::VectorXd& speed() const { return speed_; }  // [N] of the losses, |v|, rad/s or m/s
  const Eigen::VectorXd& direction() const { return direction_; }  // [N] sign(v)
  const Rows& levels() const { return levels_; }                   // [N x d] g
  const Intervals& intervals() const { return intervals_; }

 private:
  Rows Signed(const Eigen::MatrixXd& columns) const;

  Eigen::VectorXd speed_;
  Eigen::VectorXd direction_;
  Rows levels_;
  Rows loss_levels_;  // empty: levels_
  Intervals intervals_;
};

/// Derivatives by the discrete pair from those by the continuous one: columns k and tau (the last
/// three are k, tau, E0) become ke and te. h: the even sampling interval, s.
Eigen::MatrixXd ByDiscretePair(const Eigen::MatrixXd& jacobian, const Thermal& thermal, double h);

}  // namespace warmjoint
