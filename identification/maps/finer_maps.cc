#include "identification/maps/finer_maps.h"

#include <warmjoint/friction.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "identification/uncertainty/noise_model.h"
#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr double kDead = 1e-3;  // of the variance; why: far below what few draws can tell

/// Samples after which nothing is left of a start from 0.
Index Settling(const NoiseModel& noise, Index most) {
  if (noise.order() == 0) return 0;
  const Eigen::VectorXd covariances = CovariancesOf(noise, most);
  Index last = most;
  while (last > 0 && std::abs(covariances[last]) <= kDead * noise.variance) --last;
  return std::max(last, noise.order());
}

/// Courses of n samples each of stationary noise of that colour, in N.m or N, [n x courses]. What drives it is uniform:
/// its covariances are the model's, its higher moments are not.
Eigen::MatrixXd DrawNoise(const NoiseModel& noise, Index n, Index courses, StartStream& stream) {
  const Index p = noise.order();
  // half the width of a uniform distribution with the variance of the innovations
  const double half = std::sqrt(3 * (p == 0 ? noise.variance : noise.innovation));
  Eigen::VectorXd drawn(Settling(noise, n) + n);
  Eigen::MatrixXd all(n, courses);
  for (auto course : all.colwise()) {
    // the model's recursion, begun early enough to have settled
    for (Index i = 0; i < drawn.size(); ++i) {
      drawn[i] = stream.Uniform(-half, half);
      for (Index k = 0; k < std::min(p, i); ++k) {
        drawn[i] -= noise.coefficients[k] * drawn[i - 1 - k];
      }
    }
    course = drawn.tail(n);
  }
  return all;
}

constexpr double kNarrowest = 0.7;  // of the kernels, spacings; why: no narrower shape is tried
// why 8: with 16 or 32 the bands of tests/studies/maps.yaml hold the truth as often
constexpr int kDraws = 8;

GaussianAxis TwiceAsFine(const GaussianAxis& axis) {
  const std::vector<double>& centres = axis.centres;
  if (centres.size() < 2) return axis;
  // twice the centres over the same range, as far as there may be as many
  const auto count = static_cast<int>(std::min(2 * centres.size(), kMostMapCentres));
  GaussianAxis finer = axis.period ? CircleAxis(*axis.period, count)
                                   : EvenAxis(centres.front(), centres.back(), count);
  // where there are no more, half as wide, but not so narrow that holes are left between them
  const double spacing = finer.width;
  const double as_wide = axis.width * spacing / (centres[1] - centres[0]);
  finer.width = std::min(as_wide, std::max(axis.width / 2, kNarrowest * spacing));
  return finer;
}

}  // namespace

std::vector<FrictionMap> TwiceAsFine(std::vector<FrictionMap> maps) {
  for (FrictionMap& map : maps) {
    map.weights.clear();
    const MapQuantity over = map.axes[0].quantity;
    if (over != MapQuantity::position && over != MapQuantity::motor_position) continue;
    map.axes[0].kernels = TwiceAsFine(map.axes[0].kernels);
  }
  return maps;
}

std::optional<FinerFit> FitFiner(MapProblem problem, const MapFit& fit, const NoiseModel& noise) {
  MapProblem own = problem, finer = std::move(problem);
  own.maps = fit.maps;
  finer.maps = TwiceAsFine(fit.maps);
  for (MapProblem* one : {&own, &finer}) one->rows = KernelRows::Kept(one->maps, one->points, 1);
  // the finer map at the strength of the prior that suits the map itself
  RepeatedFit finer_fits(finer, NormalOf(finer), fit.strength);
  std::optional<MapWeights> twice = finer_fits.Fit();
  if (!twice) return std::nullopt;

  // of the fit's own equations the torques change the products alone
  NormalEquations known(fit.x.size());
  known.gram = fit.gram;
  known.rows = own.torque.size();
  RepeatedFit own_fits(own, std::move(known), fit.strength);

  // the same noise to both, on top of what was measured, where bounds hold as they do there
  StartStream stream({});
  Eigen::MatrixXd torques = DrawNoise(noise, own.torque.size(), kDraws, stream);
  torques.colwise() += own.torque;
  std::optional<Eigen::MatrixXd> one = own_fits.Solve(torques), other = finer_fits.Solve(torques);
  if (!one || !other) return std::nullopt;
  one->colwise() -= fit.x;
  other->colwise() -= twice->x;
  return FinerFit{std::move(*twice), std::move(*one), std::move(*other)};
}

}  // namespace warmjoint
