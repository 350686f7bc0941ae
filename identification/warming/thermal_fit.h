// Joint maximum likelihood of law and warming over the closed loop.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <vector>

#include "identification/forward/closed_loop.h"
#include "identification/uncertainty/row_transform.h"
#include "identification/warming/scan_time_constant.h"

namespace warmjoint {

/// What is known of E(0) before the fit: it is normal about a mean. A spread of 0 holds it there, an
/// infinite one says nothing.
struct InitialEnergy {
  double mean = 0;    // N.m or N
  double spread = 0;  // standard deviation, N.m or N

  static const InitialEnergy zero, estimated;

  /// N.m or N; a spread so small that it says: exactly.
  static constexpr double kExact = 1e-12;

  /// Whether there is something to fit it to beside the log.
  bool is_expected() const { return spread > 0 && std::isfinite(spread); }
};

inline constexpr InitialEnergy InitialEnergy::zero{0, 0};
inline constexpr InitialEnergy InitialEnergy::estimated{0, std::numeric_limits<double>::infinity()};

/// One iterate of the fit.
struct ThermalIterate {
  Eigen::VectorXd
      x;  // [p] law parameters (d), k, log(tau), E(0) if estimated, jumps (J), offsets (q)
  double squares = 0;  // sum of squared residuals over the kept samples
};

struct ThermalFit {
  ThermalIterate solution;
  Eigen::MatrixXd normal;  // J^T J at the solution, of the rows as fitted, and the jumps' weights
  std::vector<ThermalIterate> trace;
  bool converged = false;

  Thermal thermal() const;
  Eigen::VectorXd parameters() const;  // [d] of the law
  bool estimates_initial_energy() const {
    return solution.x.size() > law_parameters + 2 + jump_weights.size() + offsets;
  }
  double initial_energy() const;
  Eigen::VectorXd jump_values() const;  // [J] of E, N.m or N
  Eigen::VectorXd prior() const;        // [p] what `normal` has on its diagonal beside J^T J
  Eigen::VectorXd offset_values() const { return solution.x.tail(offsets); }  // [q]
  Eigen::Index law_parameters = 0;                                            // d
  Eigen::VectorXd jump_weights;                                               // [J]
  Eigen::Index offsets = 0;                                                   // q
  InitialEnergy initial;    // what was known of E(0)
  double start_weight = 0;  // of its distance from the mean, StartWeight
};

/// To begin where a fit ended: its law and offsets, and its warming.
InitialGuess StartFrom(const ThermalFit& fit);

/// Minimises the squared residuals of the kept samples by Ceres' Levenberg-Marquardt with exact
/// derivatives. Each evaluation is condensed: [J r] is replaced by a square factor R of the same
/// products, R^T R = [J r]^T [J r], so that Ceres sees p + 1 residuals in place of N and steps
/// exactly as it would on all of them.
/// level: [N] sign(v) torque; offsets: [N x q] sign(v) dG/dg, torque that makes no heat (gravity);
/// kept: [N] weight of each sample, 1 or 0 or between; start: parameters of the law and of the
/// offsets [d + q]; scale: about the residuals' standard deviation, N.m or N; jump_weights: [J] of
/// the loop's jumps (JumpWeights): each counts as a sample that measured 0, and an expected E(0) as one
/// that measured its mean; transform: of the rows of the samples that count, whose weights are 1 then,
/// as torque; or none.
ThermalFit FitThermalFriction(const ClosedLoop& loop, const Eigen::VectorXd& level,
                              const Eigen::MatrixXd& offsets, const Eigen::VectorXd& kept,
                              const InitialGuess& start, const InitialEnergy& initial, double scale,
                              const Eigen::VectorXd& jump_weights = {},
                              const RowTransform* transform = nullptr);

/// The residuals' variance over that of E(0), or 0. scale: of the residuals, N.m or N.
inline double StartWeight(double scale, const InitialEnergy& initial) {
  if (!initial.is_expected()) return 0;
  return std::pow(scale / std::max(initial.spread, 1e-9 * scale), 2);
}

/// The residuals' variance over the variance of each jump. scale: of the residuals, N.m or N;
/// spread: [J] standard deviation that each jump is known to have, N.m or N.
inline Eigen::VectorXd JumpWeights(double scale, const Eigen::VectorXd& spread) {
  return (scale / spread.array().max(1e-9 * scale)).square();
}

}  // namespace warmjoint
