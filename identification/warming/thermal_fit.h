// Least squares of law and heat over the closed loop.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "identification/fit/fit.h"
#include "identification/forward/closed_loop.h"
#include "identification/model/model.h"
#include "identification/model/model_squares.h"
#include "identification/table.h"
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

/// Law, gravity and inertia along a log of N samples, which all fits to it share.
struct LawBlocks {
  /// law, of_losses: [N x d], of_losses empty where losses have the same; rigid: [N x q]
  LawBlocks(const LogSamples& measurements, const Eigen::MatrixXd& law,
            const Eigen::MatrixXd& of_losses, const Eigen::MatrixXd& rigid);
  /// Law alone along a motion, at which the losses are, too. law: [N x d], the columns of the loop
  LawBlocks(ClosedLoop motion, const Eigen::MatrixXd& law);

  std::shared_ptr<const ClosedLoop> loop;  // over the columns of the law, without jumps
  SharedColumns law;                       // [N x d] dFn/dp
  SharedColumns of_losses;                 // [N x d], or null
  SharedColumns rigid;                     // [N x q] dG/dg, torque that makes no heat
};

/// dF/d(p, k, tau, E(0), jumps) along the log of warm friction without a rigid part, exact. parameters: [d]; returns
/// [N x d + 3 + J]
Eigen::MatrixXd WarmJacobian(const LawBlocks& blocks, const Eigen::VectorXd& parameters,
                             const Thermal& thermal, double initial_energy,
                             const EnergyJumps& jumps = {});

struct ThermalFit;

/// A log, and how its rows count in a fit with heat.
struct ThermalRows {
  const LawBlocks& blocks;  // must outlive this
  ModelSamples samples{};   // torque in N.m or N
  InitialEnergy initial{};
  double scale = 1;                          // about the residuals' standard deviation, N.m or N
  std::vector<Eigen::Index> jump_samples{};  // [J] at which E jumps
  Eigen::VectorXd jump_spread{};  // [J] standard deviation of each jump, N.m or N, or infinite

  /// The model: law, heat, E(0) where it is not held, jumps, and gravity with inertia. Each jump has a prior about 0 with its spread,
  /// an expected E(0) one about its mean.
  Model MakeModel() const;
  /// The rms of the residual that a fit to these rows leaves.
  double ScaleOf(const ThermalFit& fit) const;
};

/// What a fit of law, heat, gravity and inertia to one log came to, its rows as they were fitted and not over their scale.
/// Without heat it has no trace, and infinite squares where the columns cannot be distinguished.
struct ThermalFit {
  Eigen::VectorXd x;            // [p]
  double squares = 0;           // (N.m)^2 or N^2
  Eigen::MatrixXd cofactor;     // [p x p] (J^T J + P)^-1
  std::vector<FitPoint> trace;  // the solution last
  bool converged = false;
  std::shared_ptr<const Model> model;
  Eigen::MatrixXd prior;            // [p x p] P: what is known of x before the log
  InitialEnergy initial;            // what was known of E(0)
  std::vector<Eigen::Index> mixed;  // columns of law and gravity that cannot be distinguished

  bool has_heat() const { return model->heat.has_value(); }
  bool estimates_initial_energy() const { return At(Role::start).size > 0; }
  Slice At(Role role) const { return model->At(role); }
  Thermal thermal() const { return model->heat->At(x); }  // of a fit with heat
  // N.m or N
  double initial_energy() const {
    return estimates_initial_energy() ? x[At(Role::start).begin] : 0;
  }
  Eigen::VectorXd law() const { return At(Role::law).Of(x); }     // [d]
  Eigen::VectorXd jumps() const { return At(Role::jump).Of(x); }  // [J] of E, N.m or N
  EnergyJumps JumpsOfE() const { return {model->heat->jump_samples, jumps()}; }
  Eigen::VectorXd rigid() const { return At(Role::gravity).Of(x); }  // [q]
  /// The deviation of an unknown for a variance of the noise.
  double Deviation(Eigen::Index i, double variance) const {
    return std::sqrt(variance * cofactor(i, i));
  }
  /// Puts the trace of the fit before in front of this one's.
  void Follow(const ThermalFit& before) {
    trace.insert(trace.begin(), before.trace.begin(), before.trace.end());
  }
};

/// To begin where a fit ended: its law, its rigid part and its warming.
InitialGuess StartFrom(const ThermalFit& fit);

/// The least squares (model/solve.h) of the samples that count, with exact derivatives. start: parameters of the law and of the rigid
/// part [d + q].
ThermalFit FitThermalFriction(const ThermalRows& rows, const InitialGuess& start);

/// The same without heat, by linear least squares. A fit has not converged where the columns cannot be distinguished.
ThermalFit FitWithoutHeat(const LawBlocks& blocks, const ModelSamples& samples);

/// E at the last sample of a fit's log, with its slopes by law, heat, E(0) where it was estimated, and jumps. [p without rigid part]
EndEnergy EndOf(const ThermalFit& fit);

}  // namespace warmjoint
