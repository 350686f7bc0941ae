// The heat of a joint's own losses along a log, with its derivatives.
#pragma once

#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <cmath>
#include <memory>
#include <vector>

#include "identification/forward/closed_loop.h"
#include "identification/table.h"

namespace warmjoint {

/// Rows of a model along a stretch of m samples.
struct ModelRows {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  SampleRange at;          // samples of the log
  Eigen::VectorXd force;   // [m] in the torque's unit
  Rows derivatives;        // [m x P] by the unknowns
  Eigen::VectorXd energy;  // [m] E of a model with heat, in the same unit

  /// Rows that are 0.
  static ModelRows Zero(const SampleRange& at, Eigen::Index p) {
    ModelRows rows;
    rows.Reset(at, p);
    return rows;
  }
  void Reset(const SampleRange& stretch, Eigen::Index p) {
    at = stretch;
    force.setZero(stretch.count);
    derivatives.setZero(stretch.count, p);
  }
};

/// E at a sample, and its derivatives by all unknowns.
struct HeatState {
  double energy = 0;       // N.m or N
  Eigen::VectorXd slopes;  // [P]
};

/// The loop that Eqs. (19) to (22) close, E -> F -> W -> E, losses held over each interval. With the level L of all friction
/// blocks, against the motion,
///     E[n+1] = te E[n] + ke |v[n]| (L[n] + E[n]),
/// so that the derivatives S of E by all unknowns share the pole lambda = te + ke |v|:
///     of friction:  S[n+1] = lambda S[n] + ke |v| dL/dp       k:        lambda S[n] + (1 - te) |v| (L + E)
///     E(0):         S[n+1] = lambda S[n], S[0] = 1            log tau:  lambda S[n] + te h/tau (E - k |v| (L + E))
/// A jump b of E at a sample: S = 0 before, 1 there, then lambda S[n]. Samples at rest have no loss and keep cooling. With uneven
/// sampling each interval is exact.
struct HeatLoop {
  std::shared_ptr<const ClosedLoop> loop;    // the motion, without columns
  Eigen::VectorXd direction;                 // [N] of the force, as the log shows it
  Eigen::Index friction = 0;                 // the first unknowns, among which are all of friction
  Slice parameters;                          // k and log tau
  Slice start{};                             // E(0), or none
  std::vector<Eigen::Index> jump_samples{};  // [J] ascending
  Slice jumps{};                             // [J]

  Thermal At(const Eigen::VectorXd& x) const {
    return {x[parameters.begin], std::exp(x[parameters.begin + 1])};
  }
  /// The state at the first sample.
  HeatState Begin(const Eigen::VectorXd& x) const;
  /// The jump of E at the last sample, if there is one.
  void EnterLast(const Eigen::VectorXd& x, HeatState& state) const;
  /// Adds E and its derivatives to rows that hold the friction. losses: rows of the friction by which it makes heat, which may
  /// be `rows`; holds: over the intervals at x; state: at the first sample of the stretch, led on to the one after the last
  void Add(const Eigen::VectorXd& x, const std::vector<IntervalHold>& holds,
           const ModelRows& losses, HeatState& state, ModelRows& rows) const;
};

}  // namespace warmjoint
