#include "identification/maps/friction_at_speeds.h"

#include <algorithm>
#include <cmath>

#include "identification/linear/linear_laws.h"
#include "identification/ridge/local_rows.h"
#include "identification/uncertainty/tails.h"
#include "models/foundation/robust_noise.h"
#include "models/friction/sign.h"

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr Index kEnough = 1000;  // samples that tell a mean over places
constexpr double kAlike = 0.2;   // of ln |v|; why: speeds nearer to each other are held as one
constexpr int kRounds = 5;       // why: from the edge of kAlike to the middle of what is within
constexpr double kSlow = 0.05, kFast = 0.95;  // why: a tenth of the samples lies about either
constexpr int kVelocity = static_cast<int>(MapQuantity::velocity);

/// Mean velocity of a group of points, rad/s or m/s. Summed here: Eigen 3.4 sums a view of some rows of a column of a
/// matrix by rows over other elements.
double MeanVelocity(const std::vector<Index>& group, const MapPoints& kept) {
  double sum = 0;
  for (const Index i : group) sum += kept(i, kVelocity);
  return sum / static_cast<double>(group.size());
}

/// Those of some points about a speed that the joint held, from one of the speeds on to where they gather.
std::vector<Index> Gather(double speed, const std::vector<Index>& way, const MapPoints& kept) {
  std::vector<Index> group;
  for (int round = 0; round < kRounds; ++round) {
    group.clear();
    for (const Index i : way) {
      if (std::abs(std::log(std::abs(kept(i, kVelocity)) / speed)) <= kAlike) group.push_back(i);
    }
    speed = std::abs(MeanVelocity(group, kept));
  }
  return group;
}

/// a of the mean over the points of a group, or over every so manieth of many. [p + q]
Eigen::RowVectorXd MeanOver(const std::vector<Index>& group, const Law& law, const MapFit& fit,
                            const MapPoints& kept) {
  const auto all = static_cast<Index>(group.size()), some = std::min(all, kEnough);
  std::vector<Index> chosen;
  for (Index i = 0; i < some; ++i) chosen.push_back(group[static_cast<size_t>(i * all / some)]);
  const MapPoints points = kept(chosen, Eigen::all);
  const Eigen::MatrixXd columns = LawColumns(law, points.col(kVelocity));
  const Eigen::MatrixXd kernels = DenseKernels(fit.maps, points, 0, some);
  // resistance is the force times the direction
  Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(fit.x.size());
  mean.head(columns.cols()) = columns.colwise().mean();
  mean.tail(kernels.cols()) = kernels.colwise().mean();
  return Sign(points(0, kVelocity)) * mean;
}

}  // namespace

std::vector<FrictionAtSpeed> FrictionAtSpeeds(const Law& law, const MapFit& fit,
                                              const Uncertainty& known, const MapPoints& kept) {
  const Eigen::MatrixXd covariance = known.covariance.topLeftCorner(fit.x.size(), fit.x.size());
  const double reach = StudentQuantile(known.freedom, kIntervalLevel);
  std::vector<FrictionAtSpeed> all;
  for (const int direction : {1, -1}) {
    std::vector<Index> way;
    for (Index i = 0; i < kept.rows(); ++i) {
      if (Sign(kept(i, kVelocity)) == direction) way.push_back(i);
    }
    double latest = 0;
    for (const double quantile : {kSlow, 0.5, kFast}) {
      if (way.empty()) continue;
      Eigen::VectorXd speeds = kept(way, kVelocity).cwiseAbs();
      const std::vector<Index> group = Gather(QuantileInPlace(speeds, quantile), way, kept);
      const double speed = MeanVelocity(group, kept);
      // a joint that knows one speed has one figure
      if (latest > 0 && !(std::log(std::abs(speed) / latest) > kAlike)) continue;
      latest = std::abs(speed);
      // linear in law and weights, so that its variance follows from their covariance
      const Eigen::RowVectorXd row = MeanOver(group, law, fit, kept);
      const double value = row * fit.x;
      const double deviation = std::sqrt(std::max(0.0, double(row * covariance * row.transpose())));
      all.push_back(
          {speed, value, deviation, {value - reach * deviation, value + reach * deviation}});
    }
  }
  return all;
}

}  // namespace warmjoint
