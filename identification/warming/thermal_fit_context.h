// What all passes of a joint fit of law and warming share.
#pragma once

#include <string>
#include <vector>

#include "identification/fit.h"
#include "identification/identifier.h"
#include "identification/linear/least_squares.h"
#include "identification/linear/rigid_part.h"
#include "identification/warming/gaps.h"
#include "identification/warming/robust_thermal_fit.h"
#include "identification/warming/scan_time_constant.h"

namespace warmjoint {

/// A log and a law, as all passes see them, and what the first one learned.
struct ThermalFitContext {
  const IdentifierInput& input;  // without gravity where it is known
  const LinearTask& task;
  Eigen::MatrixXd kept_columns;  // [n x d] law, then gravity
  Eigen::VectorXd torque;        // [n] N.m or N
  LeastSquares nominal;          // without warming
  double nominal_squares;        // that it leaves; infinite where its columns are not told apart
  Selection moving;              // of the kept samples
  Eigen::VectorXd kept;          // [N] 1 where moving
  ClosedLoop loop;
  Eigen::VectorXd level;    // [N] sign(v) torque
  Eigen::MatrixXd offsets;  // [N x q] sign(v) dG/dg
  std::vector<LogGap> gaps;
  Eigen::VectorXd spread;  // [J] of the jumps at gaps
  /// The clause that the log contradicts the start that was expected; or empty.
  std::string unlike_before;

  ThermalFitContext(const IdentifierInput& from, const LinearTask& linear);

  /// Whether every kept sample moves: those at rest, which tell nothing, would part the rows of a fit from
  /// those of its errors.
  bool KeepsNoRest() const { return moving.count() == input.selection.count(); }
};

/// A start for all linear parameters, law before gravity, and the warming: the scan over tau once
/// gravity is out of the loss. level: [N] as ThermalFitContext::level
InitialGuess Scan(const ThermalFitContext& course, const Eigen::VectorXd& level);

/// Squares that linear least squares leave; infinite where their columns are not told apart. A: [n x d]; y: [n]
double LeftOver(const Eigen::MatrixXd& A, const Eigen::VectorXd& y);

/// How sure a fit to plain squares is of its x, whatever the colour of the noise.
Uncertainty CovarianceOf(const ThermalFitContext& course, const ThermalFit& plain);

}  // namespace warmjoint
