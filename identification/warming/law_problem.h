// A log, law, gravity and heat in the form that every pass of a least-squares fit uses.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "identification/fit/fit.h"
#include "identification/fit/identifier.h"
#include "identification/linear/rigid_part.h"
#include "identification/warming/gaps.h"
#include "identification/warming/thermal_fit.h"

namespace warmjoint {

/// The treatment of the kept samples by a least-squares fit.
struct RowTreatment {
  Eigen::VectorXd torque;     // [n] N.m or N, that is fitted; with a lag LaggedRows::BeforeLag
  Eigen::VectorXd weights{};  // [n] of the squares; or empty: 1
  std::shared_ptr<const RowTransform> transform{};  // of columns and torque; or none
  double scale = 1;  // about the standard deviation of what is left, N.m or N
};

/// The response of a fit along its log.
struct ThermalResponse {
  Eigen::VectorXd force;                      // [N] F, N.m or N
  Eigen::VectorXd torque;                     // [N] F + G + M a, N.m or N
  std::optional<Eigen::Index> first_driving;  // LoopResponse::first_driving
};

/// Law, gravity and inertia, with or without heat.
class LawProblem {
 public:
  /// input: without samples at rest; input and task must outlive this.
  LawProblem(const IdentifierInput& input, const LinearTask& task);

  /// The rows as they were measured.
  RowTreatment AsMeasured() const;
  /// The samples of a fit to treated rows.
  ModelSamples SamplesFor(const RowTreatment& rows) const;
  /// Without heat, by linear least squares. A fit has not converged where the columns cannot be distinguished.
  ThermalFit FitCold(const RowTreatment& rows) const;
  /// With heat.
  ThermalFit FitWarm(const RowTreatment& rows, const InitialEnergy& initial,
                     const InitialGuess& start) const;
  /// Once more from where a fit ended, with heat where it has any; its trace goes on.
  ThermalFit FitAgain(const RowTreatment& rows, const ThermalFit& fit) const;

  /// A start for all linear parameters, law before gravity, and the warming: the scan over tau once gravity is out of
  /// the loss. torque: [N]; cold: FitCold(AsMeasured())
  InitialGuess Scan(const Eigen::VectorXd& torque, const ThermalFit& cold) const;

  ThermalResponse Respond(const ThermalFit& fit) const;
  /// d(F + G + M a)/dx over all samples, without lag. [N x p]
  static Eigen::MatrixXd JacobianOf(const ThermalFit& fit);
  /// The uncertainty of x of a fit to plain squares, for noise of any colour. residual: [n] that it leaves
  Uncertainty CovarianceOf(const ThermalFit& plain, const Eigen::VectorXd& residual) const;

  const IdentifierInput& input() const { return input_; }
  const LinearTask& task() const { return task_; }
  /// The rows of fits with heat, without any treatment.
  ThermalRows WarmRows(const InitialEnergy& initial, double scale) const {
    return RowsFor(AsMeasured(), initial, scale);
  }

  /// Sets the gaps and further starts at which E jumps, and how large the jumps may be. spread: [J] N.m or N
  void TakeJumps(const std::vector<LogGap>& gaps, const Eigen::VectorXd& spread);
  const std::vector<LogGap>& gaps() const { return gaps_; }

 private:
  ThermalRows RowsFor(const RowTreatment& rows, const InitialEnergy& initial, double scale) const;

  const IdentifierInput& input_;
  const LinearTask& task_;
  LawBlocks blocks_;
  std::vector<LogGap> gaps_;
  Eigen::VectorXd jump_spread_;  // [J]
};

}  // namespace warmjoint
