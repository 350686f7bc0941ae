#include "identification/maps/friction_at_speeds.h"

#include <algorithm>
#include <cmath>

#include "identification/linear/linear_laws.h"
#include "identification/ridge/local_rows.h"
#include "identification/uncertainty/tails.h"
#include "models/foundation/robust_noise.h"
#include "models/friction/sign.h"

namespace warmjoint::inline identification {
namespace {

using Eigen::Index;

constexpr Index kEnough = 1000;   // samples that tell a mean over places
constexpr double kShare = 0.1;    // of the samples; why: it defines which are near a speed
constexpr double kAlike = 0.001;  // speeds that are one
constexpr int kVelocity = static_cast<int>(MapQuantity::velocity);

/// Those of the points that move.
MapPoints Moving(const MapPoints& kept) {
  std::vector<Index> moving;
  for (Index i = 0; i < kept.rows(); ++i) {
    if (kept(i, kVelocity) != 0) moving.push_back(i);
  }
  return kept(moving, Eigen::all);
}

/// The tenth of the points that move with the speed nearest to u and those as near, or every so manieth of them.
MapPoints AtSpeed(double u, const MapPoints& points) {
  const Eigen::VectorXd away = (points.col(kVelocity).cwiseAbs().array() - u).abs();
  Eigen::VectorXd sorted = away;
  const double reach = std::max(QuantileInPlace(sorted, kShare), kAlike * u);
  // points as near to the speed as the nearest tenth
  std::vector<Index> near;
  for (Index i = 0; i < away.size(); ++i) {
    if (away[i] <= reach) near.push_back(i);
  }
  const auto all = static_cast<Index>(near.size());
  // every so manieth where there are more than it takes
  const Index some = std::min(all, kEnough);
  std::vector<Index> chosen;
  for (Index i = 0; i < some; ++i) chosen.push_back(near[static_cast<size_t>(i * all / some)]);
  return points(chosen, Eigen::all);
}

/// a of the mean at one speed. [p + q]
Eigen::RowVectorXd MeanAt(double speed, const Law& law, const MapFit& fit, MapPoints points) {
  // the places stay, each in its own direction, but all at the one speed
  const Eigen::VectorXd side = points.col(kVelocity).array().sign();
  points.col(kVelocity) = speed * side;
  const Eigen::MatrixXd columns = LawColumns(law, points.col(kVelocity));
  const Eigen::MatrixXd kernels = DenseKernels(fit.maps, points, 0, points.rows());
  const auto n = static_cast<double>(points.rows());
  // resistance is the force times the direction
  Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(fit.x.size());
  mean.head(columns.cols()) = side.transpose() * columns / n;
  mean.tail(kernels.cols()) = side.transpose() * kernels / n;
  return mean;
}

}  // namespace

std::vector<FrictionAtSpeed> FrictionAtSpeeds(const Law& law, const MapFit& fit,
                                              const Uncertainty& known, const MapPoints& kept) {
  const MapPoints points = Moving(kept);
  if (points.rows() == 0) return {};
  // the lowest, the median and the highest speed of the log
  Eigen::VectorXd speeds = points.col(kVelocity).cwiseAbs();
  const double lowest = speeds.minCoeff(), highest = speeds.maxCoeff();
  const double median = MedianInPlace(speeds);
  const Eigen::MatrixXd covariance = known.covariance.topLeftCorner(fit.x.size(), fit.x.size());
  const double reach = StudentQuantile(known.freedom, kIntervalLevel);
  std::vector<FrictionAtSpeed> all;
  for (const double speed : {lowest, median, highest}) {
    // a joint that knows one speed has one figure
    if (!all.empty() && !(speed > (1 + kAlike) * all.back().speed)) continue;
    const Eigen::RowVectorXd row = MeanAt(speed, law, fit, AtSpeed(speed, points));
    // linear in law and weights, so that its variance follows from their covariance
    const double value = row * fit.x;
    const double deviation = std::sqrt(std::max(0.0, double(row * covariance * row.transpose())));
    all.push_back(
        {speed, value, deviation, {value - reach * deviation, value + reach * deviation}});
  }
  return all;
}

}  // namespace warmjoint::inline identification
