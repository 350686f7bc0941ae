// Least squares of law and heat over the closed loop.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <vector>

#include "identification/forward/closed_loop.h"
#include "identification/forward/row_products.h"
#include "identification/layout.h"
#include "identification/warming/scan_time_constant.h"

namespace warmjoint {

/// What is known of E(0) before the fit: it is normal about a mean. A spread of 0 holds it there, an
/// infinite one is no prior.
struct InitialEnergy {
  double mean = 0;    // N.m or N
  double spread = 0;  // standard deviation, N.m or N

  static const InitialEnergy zero, estimated;

  /// N.m or N; a spread so small that it says: exactly.
  static constexpr double kExact = 1e-12;

  /// Whether it is estimated from the log alone.
  bool is_open() const { return std::isinf(spread); }
  /// Whether it is fitted to a prior expectation in addition to the log.
  bool is_expected() const { return spread > 0 && std::isfinite(spread); }
};

inline constexpr InitialEnergy InitialEnergy::zero{0, 0};
inline constexpr InitialEnergy InitialEnergy::estimated{0, std::numeric_limits<double>::infinity()};

/// A log, and how its rows count in a fit. Refers to what it is given.
struct ThermalRows {
  const ClosedLoop& loop;          // over the columns of the law, with the jumps of E
  const Eigen::VectorXd& level;    // [N] sign(v) torque, N.m or N
  const Eigen::MatrixXd& offsets;  // [N x q] sign(v) dG/dg, torque that makes no heat
  const Eigen::VectorXd& weight;   // [N] of the squares: 1, 0 or between
  InitialEnergy initial{};
  double scale = 1;               // about the residuals' standard deviation, N.m or N
  Eigen::VectorXd jump_spread{};  // [J] standard deviation of each jump, N.m or N, or infinite
  /// Of the rows that count, whose weights are 1 then, as torque; or none.
  const RowTransform* transform = nullptr;

  /// Law, heat, E(0) where it is not held, jumps, gravity and inertia.
  Layout layout() const;
  /// The same rows along another loop, which must outlive what is returned.
  ThermalRows Along(const ClosedLoop& other) const {
    return {.loop = other,
            .level = level,
            .offsets = offsets,
            .weight = weight,
            .initial = initial,
            .scale = scale,
            .jump_spread = jump_spread,
            .transform = transform};
  }
};

/// What a fit of law, heat, gravity and inertia to one log came to, its rows as they were fitted and not over their scale.
/// Without heat it has no trace, and infinite squares where the columns cannot be distinguished.
struct ThermalFit {
  Eigen::VectorXd x;            // [p]
  double squares = 0;           // (N.m)^2 or N^2
  Eigen::MatrixXd cofactor;     // [p x p] (J^T J + P)^-1
  std::vector<FitPoint> trace;  // the solution last
  bool converged = false;
  Layout layout;
  Eigen::VectorXd prior;            // [p] the diagonal P: what is known of x before the log
  InitialEnergy initial;            // what was known of E(0)
  std::vector<Eigen::Index> mixed;  // columns of law and gravity that cannot be distinguished

  bool has_heat() const { return layout.heat.size > 0; }
  bool estimates_initial_energy() const { return layout.start.size > 0; }
  Thermal thermal() const { return layout.ThermalAt(x); }  // of a fit with heat
  // N.m or N
  double initial_energy() const { return estimates_initial_energy() ? x[layout.energy()] : 0; }
  Eigen::VectorXd law() const { return layout.law.Of(x); }      // [d]
  Eigen::VectorXd jumps() const { return layout.jumps.Of(x); }  // [J] of E, N.m or N
  Eigen::VectorXd rigid() const { return layout.rigid.Of(x); }  // [q]
  /// The deviation of an unknown for a variance of the noise.
  double Deviation(Eigen::Index i, double variance) const {
    return std::sqrt(variance * cofactor(i, i));
  }
  /// Puts the trace of the fit before in front of this one's.
  void Follow(const ThermalFit& before) {
    trace.insert(trace.begin(), before.trace.begin(), before.trace.end());
  }
};

/// To begin where a fit ended: its law and offsets, and its warming.
InitialGuess StartFrom(const ThermalFit& fit);

/// Minimises the squared residuals of the samples that count (model/minimise.h) with exact derivatives. start: parameters of the
/// law and of the offsets [d + q]. Each jump counts as a sample that measured 0 with its spread, and an expected E(0) as one that
/// measured its mean.
ThermalFit FitThermalFriction(const ThermalRows& rows, const InitialGuess& start);

}  // namespace warmjoint
