// The intervals where the residual is structure instead of noise.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "identification/fit/cause.h"
#include "identification/fit/fit.h"

namespace warmjoint {

/// Parameters of one fit, with their covariance.
struct FitOfRows {
  Eigen::VectorXd x;           // [p]
  Eigen::MatrixXd covariance;  // [p x p]
};

/// The parameter by which two fits differ most.
struct Disagreement {
  Eigen::Index parameter = 0;
  double deviations = 0;          // of its difference, by noise alone
  Eigen::VectorXd differences{};  // [p] of the whitened fit from the plain one
};

/// Both fits are right on average where the residual is noise, whatever its colour, and then their
/// difference has the variance of the plain one less that of the whitened one, which is the efficient
/// one (Hausman 1978). Structure makes them differ, since they weigh its slow and its fast part
/// differently. Returns where they differ beyond doubt: by what noise does to any of p parameters
/// less often than five deviations of a normal variable; nothing where the difference may be noise. The variance
/// counts as a tenth of the plain one's at least. degrees_of_freedom: of the plain fit's variance.
std::optional<Disagreement> FindDisagreement(const FitOfRows& plain, const FitOfRows& whitened,
                                             double degrees_of_freedom);

/// The difference d of the whitened fit from the plain one shows about how much structure in the residual biases
/// the parameters: d is taken as the standard deviation of that bias. Where J d stays below a tenth of the friction, as
/// `--relevance` has it by default, the row widens intervals by |d| times Student's quantile for the noise's fewest degrees of
/// freedom; beyond it no number gets an interval. friction: [n] F at the kept samples, N.m or N; fit: with its table, Jacobian and errors
Cause StructureCause(const Disagreement& structure, const Eigen::VectorXd& friction,
                     const Fit& fit);

}  // namespace warmjoint
