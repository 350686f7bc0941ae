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

constexpr Index kEnough = 1000;  // samples that tell a mean over places
constexpr int kVelocity = static_cast<int>(MapQuantity::velocity);

/// Every so manieth of the points that move.
MapPoints Some(const MapPoints& kept) {
  std::vector<Index> moving;
  for (Index i = 0; i < kept.rows(); ++i) {
    if (kept(i, kVelocity) != 0) moving.push_back(i);
  }
  const auto all = static_cast<Index>(moving.size());
  const Index some = std::min(all, kEnough);
  MapPoints points(some, 5);
  for (Index i = 0; i < some; ++i) {
    points.row(i) = kept.row(moving[static_cast<size_t>(i * all / some)]);
  }
  return points;
}

/// a of the mean at one speed. [p + q]
Eigen::RowVectorXd MeanAt(double speed, const Law& law, const MapFit& fit, MapPoints points) {
  const Eigen::VectorXd side = points.col(kVelocity).array().sign();
  points.col(kVelocity) = speed * side;
  const Eigen::MatrixXd columns = LawColumns(law, points.col(kVelocity));
  const Eigen::MatrixXd kernels = DenseKernels(fit.maps, points, 0, points.rows());
  const auto n = static_cast<double>(points.rows());
  Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(fit.x.size());
  mean.head(columns.cols()) = side.transpose() * columns / n;
  mean.tail(kernels.cols()) = side.transpose() * kernels / n;
  return mean;
}

}  // namespace

std::vector<FrictionAtSpeed> FrictionAtSpeeds(const Law& law, const MapFit& fit,
                                              const Uncertainty& known, const MapPoints& kept) {
  const MapPoints points = Some(kept);
  if (points.rows() == 0) return {};
  Eigen::VectorXd speeds = points.col(kVelocity).cwiseAbs();
  const double lowest = speeds.minCoeff(), highest = speeds.maxCoeff();
  const double median = MedianInPlace(speeds);
  const Eigen::MatrixXd covariance = known.covariance.topLeftCorner(fit.x.size(), fit.x.size());
  const double reach = StudentQuantile(known.freedom, kIntervalLevel);
  std::vector<FrictionAtSpeed> all;
  for (const double speed : {lowest, median, highest}) {
    // a joint that knows one speed has one figure
    if (!all.empty() && !(speed > 1.001 * all.back().speed)) continue;
    const Eigen::RowVectorXd row = MeanAt(speed, law, fit, points);
    const double value = row * fit.x;
    const double deviation = std::sqrt(std::max(0.0, double(row * covariance * row.transpose())));
    all.push_back(
        {speed, value, deviation, {value - reach * deviation, value + reach * deviation}});
  }
  return all;
}

}  // namespace warmjoint::inline identification
