// How uncertain the parameters of a least-squares fit are when its noise may be coloured.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "identification/uncertainty/noise_model.h"

namespace warmjoint {

struct Uncertainty {
  Eigen::MatrixXd covariance;     // [d x d] of the parameters
  double degrees_of_freedom = 1;  // degrees of freedom of the noise's variance
  Eigen::VectorXd
      each_degrees_of_freedom;  // [d] of the variance of each parameter, where they differ; or empty
  NoiseModel noise;
  double uneven = 0;  // deviations by which the noise's variance changes; 0 where it may be even

  // what it is made of
  Eigen::MatrixXd white;       // [d x d] were the noise white and even; or empty: not known
  Eigen::MatrixXd by_samples;  // [d x d] before few segments counted; or empty: they do not
  double samples_degrees_of_freedom = 1;  // of that

  /// Standard deviation of parameter i.
  double Deviation(Eigen::Index i) const { return std::sqrt(covariance(i, i)); }
  /// Degrees of freedom of that.
  double DegreesOfFreedom(Eigen::Index i) const {
    return each_degrees_of_freedom.size() > 0 ? each_degrees_of_freedom[i] : degrees_of_freedom;
  }
};

/// That of some parameters. places: [q] of them, in the order of the result
Uncertainty Picked(Uncertainty known, const std::vector<Eigen::Index>& places);

/// Covariance of x = argmin |y - f(x)|^2 for stationary noise: C (J^T R J) C, C = (J^T J)^-1, with
/// R from an autoregressive model of the residual (noise_model.h). For white noise it is s^2 C.
/// The residual is smaller than the noise by what the fit took up, tr(C J^T R J): the variance is
/// scaled up by that, as n/(n - d) does for white noise.
/// Where r^2 goes with |f| or with time, by more than 4 deviations of n^(1/2) times their
/// correlation (Koenker 1981), the noise's variance is not even. Then white noise takes
/// n/(n - d) C (sum of r^2 j^T j over the rows j of J) C (HC1, White 1980). Coloured noise is taken
/// for s(|f|, t) u with a stationary u: s is the line through |r|, R that of u, and J is weighted
/// by s.
/// jacobian: [n x d] df/dx over the kept samples, asked for where noise is not white and even; cofactor: C; residual: [n] y - f; fitted: [n] f,
/// or empty where only time is asked about; prior: [d] what
/// is known of x beforehand, P = diag(prior): the noise's variance over the variance of each
/// parameter, or 0. With it C = (J^T J + P)^-1, and P times the noise's variance joins J^T R J.
Uncertainty EstimateCovariance(const std::function<Eigen::MatrixXd()>& jacobian,
                               const Eigen::MatrixXd& cofactor, const Eigen::VectorXd& residual,
                               const Selection& selection, const Eigen::VectorXd& fitted = {},
                               const Eigen::VectorXd& prior = {});

/// Variance that the rounding of doubles leaves in the residual of an exact torque: sums over n samples carry errors of
/// some sqrt(n) units in the last digit of the largest (Higham, Accuracy and Stability, 2002, 3.1). What is below is no
/// noise and no structure. torque: [n] N.m or N
double RoundingVariance(const Eigen::VectorXd& torque);

/// Whether squares over the samples of a torque are no more than that.
bool IsRounding(double squares, const Eigen::VectorXd& torque);

/// Drop of the squares by something that a fit has and another has not, in variances of the noise that is left with it;
/// 0 where rounding was all that there was to explain. degrees_of_freedom: samples less parameters
double ExplainedVariances(double without, double with, double degrees_of_freedom,
                          const Eigen::VectorXd& torque);

/// A half sentence on the colour of the noise, "" for white: "; noise is coloured (correlation 0.90
/// between neighbours), which the intervals account for".
std::string ColourOf(const NoiseModel& noise);

/// The same, after one on noise that is not even: "; noise is uneven (...), which ...".
std::string NoiseOf(const Uncertainty& known);

}  // namespace warmjoint
