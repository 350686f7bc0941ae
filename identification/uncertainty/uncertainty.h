// How uncertain the parameters of a least-squares fit are when its noise may be coloured.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "identification/uncertainty/noise_model.h"
#include "identification/uncertainty/weight_prior.h"

namespace warmjoint {

/// Of what the error of a fit with fields is made, each given those after it.
enum class ErrorBy { noise, description, place, speed, time, strength };

/// The deviation of a figure up to one of these, or a covariance.
template <class T>
struct ErrorUpTo {
  ErrorBy by = ErrorBy::noise;
  T value{};
};

struct Uncertainty {
  Eigen::MatrixXd covariance;     // [d x d] of the parameters
  double degrees_of_freedom = 1;  // degrees of freedom of the noise's variance
  Eigen::VectorXd
      each_degrees_of_freedom;  // [d] of the variance of each parameter, where they differ; or empty
  NoiseModel noise;
  double uneven = 0;  // deviations by which the noise's variance changes; 0 where it may be even

  // what it is made of
  Eigen::MatrixXd white;  // [d x d] were the noise white and even; or empty: not known
  /// [d x d] covariance by all samples, where segments are few; or empty
  Eigen::MatrixXd by_samples;
  double samples_degrees_of_freedom = 1;  // of `by_samples`
  /// [d x d] covariances where all is known that comes later, of a fit with fields; or empty
  std::vector<ErrorUpTo<Eigen::MatrixXd>> up_to{};

  /// Standard deviation of parameter i.
  double Deviation(Eigen::Index i) const { return std::sqrt(covariance(i, i)); }
  /// Degrees of freedom of the variance of parameter i.
  double DegreesOfFreedom(Eigen::Index i) const {
    return each_degrees_of_freedom.size() > 0 ? each_degrees_of_freedom[i] : degrees_of_freedom;
  }
};

/// The uncertainty of some of the parameters. places: [q] of them, in the order of the result
Uncertainty Picked(Uncertainty uncertainty, const std::vector<Eigen::Index>& places);

/// A fit x = argmin (y - f(x))^T W (y - f(x)) + x^T P x about its solution, as the errors of x follow from it.
struct FittedRows {
  /// of J = df/dx [n x d], needed only where noise is not white or not of constant variance
  RowsBetween rows;
  Eigen::MatrixXd cofactor;  // [d x d] C = (J^T W J + P)^-1
  Eigen::VectorXd residual;  // [n] y - f
  const Selection& selection;
  Eigen::VectorXd fitted{};   // [n] f; or empty: not known
  Eigen::VectorXd weights{};  // [n] diagonal of W; or empty: 1
  /// [d x d] what is known of x beforehand, P: the noise's variance times the precision of its normal density; or empty
  Eigen::MatrixXd prior{};
  /// The noise's variance that P is made with, where the fit had another than that of the residual; 0: the same
  double prior_variance = 0;
  std::optional<WeightPrior> pull{};  // s |w|^2, which is in C as well
};

/// Rows that are there already, or are made all at once.
RowsBetween RowsFrom(std::function<Eigen::MatrixXd()> all);

/// Covariance of the errors of x, from the noise, from what was known beforehand, and from what a prior pulls away:
///   C J^T W R W J C + v C P C + s^2 C_w S C_w^T (weight_prior.h),
/// R the covariance of the noise of variance v by an autoregressive model of the residual (noise_model.h). For white noise
/// without weights and pull it is v C. The residual is smaller than the noise by what the fit took up, 2 tr(C J^T R J) -
/// tr(C G C J^T R J), G = J^T J: the variance is scaled up by that, as n/(n - d) does for white noise without a pull.
/// Where r^2 varies with |f| or with time, by more than 4 deviations of n^(1/2) times their correlation (Koenker 1981), the
/// noise's variance is not constant. White noise then has the sum of r^2 j^T j over the rows j of J in place of J^T R J (HC1, White 1980).
/// Coloured noise is taken for s(|f|, t) u with a stationary u: s is the line through |r|, R that of u, and J is weighted by s.
/// A residual that rounding makes (IsRounding) has its variance. Where segments are few, and nothing is known beforehand, the
/// scatter of the segments' scores counts (few_segments.h).
Uncertainty CovarianceOf(const FittedRows& fit);

/// Whether squares over the samples of a torque are no more than what rounding leaves.
bool IsRounding(double squares, const Eigen::VectorXd& torque);

/// Drop of the squares by something that a fit has and another has not, in variances of the noise that is left with it;
/// 0 where there was only rounding to explain. degrees_of_freedom: samples less parameters
double ExplainedVariances(double without, double with, double degrees_of_freedom,
                          const Eigen::VectorXd& torque);

/// Degrees of freedom of the noise's variance that n weighted samples leave after d parameters were fitted: at
/// least 1. (sum w)^2 / sum w^2 of them count. weights: [n].
double DegreesOfFreedomOfWeights(const Eigen::VectorXd& weights, const NoiseModel& noise,
                                 Eigen::Index d);

/// A half sentence on the colour of the noise, "" for white: "; noise is coloured (correlation 0.90
/// between neighbours), which the intervals account for".
std::string ColourOf(const NoiseModel& noise);

/// The same, after one on noise that is not even: "; noise is uneven (...), which ...".
std::string NoiseOf(const Uncertainty& uncertainty);

}  // namespace warmjoint
