// How uncertain the parameters of a least-squares fit are when its noise may be coloured.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <string>

#include "identification/uncertainty/noise_model.h"

namespace warmjoint {

struct Uncertainty {
  Eigen::MatrixXd covariance;  // [d x d] of the parameters
  double freedom = 1;          // degrees of freedom of the noise's variance
  NoiseModel noise;

  /// Standard deviation of parameter i.
  double Deviation(Eigen::Index i) const { return std::sqrt(covariance(i, i)); }
};

/// Covariance of x = argmin |y - f(x)|^2 for stationary noise: C (J^T R J) C, C = (J^T J)^-1, with
/// R from an autoregressive model of the residual (noise_model.h). For white noise it is s^2 C.
/// The residual is smaller than the noise by what the fit took up, tr(C J^T R J): the variance is
/// scaled up by that, as n/(n - d) does for white noise.
/// jacobian: [n x d] df/dx over the kept samples; cofactor: C; residual: [n] y - f.
Uncertainty JudgeUncertainty(const Eigen::MatrixXd& jacobian, const Eigen::MatrixXd& cofactor,
                             const Eigen::VectorXd& residual, const Selection& selection);

/// The same for a Jacobian that is costly to form: called for coloured noise alone.
Uncertainty JudgeUncertainty(const std::function<Eigen::MatrixXd()>& jacobian,
                             const Eigen::MatrixXd& cofactor, const Eigen::VectorXd& residual,
                             const Selection& selection);

/// A half sentence on the colour of the noise, "" for white: "; noise is coloured (correlation 0.90
/// between neighbours), which the intervals account for".
std::string ColourOf(const NoiseModel& noise);

}  // namespace warmjoint
