#include "identification/maps/make_bands.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "identification/linear/linear_laws.h"
#include "identification/maps/holes.h"
#include "identification/maps/local_rows.h"
#include "identification/model/normal_equations.h"
#include "identification/typical_speeds.h"
#include "identification/uncertainty/noise_model.h"
#include "identification/uncertainty/tails.h"
#include "models/foundation/random_stream.h"
#include "models/foundation/robust_noise.h"
#include "models/friction/sign.h"

namespace warmjoint {
namespace {

using Eigen::Index;

// samples; why 1000: the standard error of their mean is 3 % of their spread
constexpr Index kEnough = 1000;
// why: with 0.075 or 0.033 all bands of tests/studies/maps.yaml stay
constexpr double kBlind = 0.05;  // share of kernels without data
constexpr int kVelocity = static_cast<int>(MapQuantity::velocity);

bool IsAlikeInBothDirections(const FrictionMap& map) {
  return map.factor == MapFactor::one && !FindAxis(map, MapQuantity::velocity);
}

/// Whether the map distinguishes the directions of motion and nothing else of the velocity.
bool IsByDirection(const FrictionMap& map) {
  const MapAxis* axis = FindAxis(map, MapQuantity::velocity);
  return axis && axis->kernels.sides == Sides::apart && axis->kernels.size() == 2;
}

/// The map's centres, the last axis the fastest, as places at `speed` where it has no velocity, and at
/// the speed of the samples there where it has but a direction.
MapPoints PlacesOfBand(const FrictionMap& map, double speed, const MapPoints& kept, MapBand& band) {
  const auto count = static_cast<Index>(map.size());
  MapPoints places = MapPoints::Zero(count, 5);
  places.col(kVelocity).setConstant(speed);
  std::vector<std::optional<double>> speeds;
  if (IsByDirection(map)) speeds = SpeedsAtKernels(map, kept);
  for (Index i = 0; i < count; ++i) {
    // centre of the place along each axis
    std::vector<double> centre(map.axes.size());
    auto rest = static_cast<size_t>(i);
    for (size_t a = map.axes.size(); a-- > 0;) {
      const std::vector<double>& centres = map.axes[a].kernels.centres;
      centre[a] = centres[rest % centres.size()];
      // where the map distinguishes directions only, the place has the speed of the samples there
      const bool moved = !speeds.empty() && speeds[static_cast<size_t>(i)];
      if (moved && map.axes[a].quantity == MapQuantity::velocity) {
        centre[a] = std::copysign(*speeds[static_cast<size_t>(i)], centre[a]);
      }
      places(i, static_cast<int>(map.axes[a].quantity)) = centre[a];
      rest /= centres.size();
    }
    band.points.push_back(std::move(centre));
  }
  // quantities along the axes, for the reader of the band
  for (const MapAxis& axis : map.axes) band.quantities.emplace_back(NameOf(axis.quantity));
  return places;
}

/// Kept samples of one direction of motion.
std::vector<Index> Towards(int direction, const MapPoints& kept) {
  std::vector<Index> samples;
  for (Index i = 0; i < kept.rows(); ++i) {
    if (Sign(kept(i, kVelocity)) == direction) samples.push_back(i);
  }
  return samples;
}

/// Points of some samples, or of one in so many of them where more would hardly change a mean over them.
MapPoints Some(const std::vector<Index>& samples, const MapPoints& kept) {
  const auto all = static_cast<Index>(samples.size()), some = std::min(all, kEnough);
  std::vector<Index> chosen;
  for (Index i = 0; i < some; ++i) chosen.push_back(samples[static_cast<size_t>(i * all / some)]);
  return kept(chosen, Eigen::all);
}

/// Mean row of all kernels over some points; empty where there are none. [q]
Eigen::RowVectorXd MeanRow(const std::vector<FrictionMap>& maps, const MapPoints& points) {
  if (points.rows() == 0) return Eigen::RowVectorXd();
  return DenseKernels(maps, points, 0, points.rows()).colwise().mean();
}

/// Mean rows over the samples of both directions.
struct MeanRows {
  Eigen::RowVectorXd backwards, forwards;

  MeanRows(const std::vector<FrictionMap>& maps, const MapPoints& kept)
      : backwards(MeanRow(maps, Some(Towards(-1, kept), kept))),
        forwards(MeanRow(maps, Some(Towards(1, kept), kept))) {}
};

/// Rows whose products with a fit's x are law and maps at places of its which-th map.
Eigen::MatrixXd RowsAt(const Law& law, const MapWeights& fit, size_t which, const MapPoints& places,
                       const MeanRows& means) {
  const Index size = places.rows(), q = fit.of_weights.size;
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(size, fit.x.size());
  // the band of a map that distinguishes directions includes the law and the mean of the other maps in its direction
  if (!IsAlikeInBothDirections(fit.maps[which])) {
    const Eigen::MatrixXd columns = LawColumns(law, places.col(kVelocity));
    rows.leftCols(columns.cols()) = columns;
    for (Index i = 0; i < size; ++i) {
      const int direction = Sign(places(i, kVelocity));
      if (direction < 0 && means.backwards.size() > 0) rows.row(i).tail(q) = means.backwards;
      if (direction > 0 && means.forwards.size() > 0) rows.row(i).tail(q) = means.forwards;
    }
  }
  // its own kernels are evaluated at their own places instead of their mean
  Index first = fit.free();
  for (size_t i = 0; i < which; ++i) first += static_cast<Index>(fit.maps[i].size());
  const auto own = static_cast<Index>(fit.maps[which].size());
  rows.middleCols(first, own) = DenseKernels({fit.maps[which]}, places, 0, size);
  return rows;
}

/// The share of a place's kernels that has no data.
double ShareOfUnseen(const Eigen::RowVectorXd& row, const MapWeights& fit) {
  double share = 0;
  for (size_t k = 0; k < fit.unseen.size(); ++k) {
    if (fit.unseen[k]) share += row[fit.free() + static_cast<Index>(k)];
  }
  return share;
}

constexpr double kDead = 1e-3;  // of the variance; why: far below what few draws can show

/// The number of samples after which the effect of a start from 0 has died away.
Index Settling(const NoiseModel& noise, Index most) {
  if (noise.order() == 0) return 0;
  const Eigen::VectorXd covariances = CovariancesOf(noise, most);
  Index last = most;
  while (last > 0 && std::abs(covariances[last]) <= kDead * noise.variance) --last;
  return std::max(last, noise.order());
}

/// Series of n samples each of stationary noise of that colour, in N.m or N, [n x series]. What drives it is uniform:
/// its covariances are the model's, its higher moments are not.
Eigen::MatrixXd DrawNoise(const NoiseModel& noise, Index n, Index series, StartStream& stream) {
  const Index p = noise.order();
  // half the width of a uniform distribution with the variance of the innovations
  const double half = std::sqrt(3 * (p == 0 ? noise.variance : noise.innovation));
  Eigen::VectorXd drawn(Settling(noise, n) + n);
  Eigen::MatrixXd all(n, series);
  for (auto one : all.colwise()) {
    // the model's recursion, begun early enough to have settled
    for (Index i = 0; i < drawn.size(); ++i) {
      drawn[i] = stream.Uniform(-half, half);
      for (Index k = 0; k < std::min(p, i); ++k) {
        drawn[i] -= noise.coefficients[k] * drawn[i - 1 - k];
      }
    }
    one = drawn.tail(n);
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

/// Maps with twice the kernels, at most kMostMapCentres, along their first axis, where that is a position, over the same
/// range and as wide in spacings of their centres; all others stay. Weights are not set.
std::vector<FrictionMap> TwiceAsFine(std::vector<FrictionMap> maps) {
  for (FrictionMap& map : maps) {
    map.weights.clear();
    const MapQuantity over = map.axes[0].quantity;
    if (over != MapQuantity::position && over != MapQuantity::motor_position) continue;
    map.axes[0].kernels = TwiceAsFine(map.axes[0].kernels);
  }
  return maps;
}

/// A fit with twice the kernels, and by how much noise alone changes it and the fit with the map's own kernels.
struct FinerFit {
  MapWeights twice;
  Eigen::MatrixXd shaken;        // [p + q x draws] changes of x of the fit with its own
  Eigen::MatrixXd twice_shaken;  // [p + q2 x draws] of twice.x by the same noise
};

/// `fit` again with twice the kernels, and both again with noise added to the torque, as often as kDraws says.
/// problem: of the fit, its maps and rows are not read; noise: of its residual. Nothing where it cannot be solved.
std::optional<FinerFit> FitFiner(MapProblem problem, const MapFit& fit, const NoiseModel& noise) {
  MapProblem own = problem, finer = std::move(problem);
  own.maps = fit.maps;
  finer.maps = TwiceAsFine(fit.maps);
  for (MapProblem* one : {&own, &finer}) one->rows = KernelRows::Kept(one->maps, one->points, 1);
  // the finer map at the strength of the prior that suits the map itself
  RepeatedFit finer_fits(finer, NormalOf(finer), fit.strength);
  std::optional<MapWeights> twice = finer_fits.Fit();
  if (!twice) return std::nullopt;

  // the torques change only the products of the fit's own equations
  NormalEquations normal(fit.x.size());
  normal.gram = fit.gram;
  normal.rows = own.torque.size();
  RepeatedFit own_fits(own, std::move(normal), fit.strength);

  // the same noise is added to the measured torque in both fits, so that the same bounds hold as there
  StartStream stream({});
  Eigen::MatrixXd torques = DrawNoise(noise, own.torque.size(), kDraws, stream);
  torques.colwise() += own.torque;
  std::optional<Eigen::MatrixXd> one = own_fits.Solve(torques), other = finer_fits.Solve(torques);
  if (!one || !other) return std::nullopt;
  one->colwise() -= fit.x;
  other->colwise() -= twice->x;
  return FinerFit{std::move(*twice), std::move(*one), std::move(*other)};
}

/// Squares averaged with those of the neighbours along a map's first axis, 1 : 2 : 3 : 2 : 1; those that are not known,
/// NaN, are left out. Averages below 0, and those without a known square, are 0. Since chance alone leaves some above 0, all
/// are scaled down until those at known places sum up to no more than the squares do.
Eigen::VectorXd AlongFirstAxis(const FrictionMap& map, const Eigen::VectorXd& squares) {
  const KernelLines lines(map);
  const Index stride = lines.stride;
  Eigen::VectorXd mean(squares.size());
  double whole = 0, parts = 0;
  for (Index i = 0; i < squares.size(); ++i) {
    // neighbours on the same line, nearer ones with more weight
    double sum = 0, count = 0;
    for (const Index away : {-2, -1, 0, 1, 2}) {
      const Index at = i / stride + away, j = i + away * stride;
      if (at < 0 || at >= lines.length || std::isnan(squares[j])) continue;
      const auto share = static_cast<double>(3 - std::abs(away));
      sum += share * squares[j];
      count += share;
    }
    mean[i] = count > 0 ? std::max(sum / count, 0.0) : 0;
    if (std::isnan(squares[i])) continue;
    whole += squares[i];
    parts += mean[i];
  }
  return parts > 0 ? std::clamp(whole / parts, 0.0, 1.0) * mean : mean;
}

}  // namespace

void MakeBands(const Law& law, const MapProblem& problem, const MapFit& maps,
               const Uncertainty& uncertainty, Fit& fit) {
  const MapPoints& kept = problem.points;
  const std::optional<FinerFit> finer = FitFiner(problem, maps, uncertainty.noise);
  // typical speed, covariance of law and weights, and reach of the interval
  Eigen::VectorXd speeds = kept.col(kVelocity).cwiseAbs();
  const double speed = MedianInPlace(speeds);
  const Eigen::MatrixXd covariance =
      uncertainty.covariance.topLeftCorner(maps.x.size(), maps.x.size());
  const double reach = StudentQuantile(uncertainty.degrees_of_freedom, kIntervalLevel);
  const MeanRows means(maps.maps, kept);
  const std::optional<MeanRows> finer_means =
      finer ? std::optional<MeanRows>(std::in_place, finer->twice.maps, kept) : std::nullopt;
  size_t first = 0;
  for (size_t which = 0; which < maps.maps.size(); ++which) {
    const FrictionMap& map = maps.maps[which];
    MapBand& band = fit.figures.bands.emplace_back();
    const MapPoints places = PlacesOfBand(map, speed, kept, band);
    const Eigen::MatrixXd rows = RowsAt(law, maps, which, places, means);
    fit.figures.bands_by_law.push_back(rows.leftCols(static_cast<Index>(law.parameters.size())));
    // friction at each place, and its variance by the errors of law and weights
    const Eigen::VectorXd value = rows * maps.x;
    Eigen::VectorXd variance = (rows * covariance).cwiseProduct(rows).rowwise().sum().cwiseMax(0);
    if (finer) {
      const Eigen::MatrixXd more = RowsAt(law, finer->twice, which, places, *finer_means);
      Eigen::VectorXd missed = value - more * finer->twice.x;
      // where one of the maps has no data it cannot follow the torque, and the neighbours give the value
      for (Index i = 0; i < missed.size(); ++i) {
        const bool blind = maps.unseen[first + static_cast<size_t>(i)];
        if (blind || ShareOfUnseen(more.row(i), finer->twice) > kBlind) {
          missed[i] = std::numeric_limits<double>::quiet_NaN();
        }
      }
      // variance of that difference by noise alone
      const Eigen::VectorXd by_noise =
          (rows * finer->shaken - more * finer->twice_shaken).cwiseAbs2().rowwise().mean();
      variance += AlongFirstAxis(map, missed.cwiseAbs2() - by_noise);
    }
    const std::vector<double> doubt =
        DoubtOfHoles(map, static_cast<Index>(first), maps.unseen, maps.weights());
    first += map.size();
    for (Index i = 0; i < places.rows(); ++i) {
      // where the map has no data, its error may be as large as its variation elsewhere
      const double deviation = std::hypot(std::sqrt(variance[i]), doubt[static_cast<size_t>(i)]);
      band.value.push_back(value[i]);
      band.std.push_back(deviation);
      band.interval95.push_back({value[i] - reach * deviation, value[i] + reach * deviation});
    }
  }
}

namespace {

// rad; why: a filter against aliasing at half the sampling rate leaves 0.97 of a wave whose phase turns by less in a sample,
// and less of faster waves
constexpr double kShown = std::numbers::pi / 2;

/// Amplitude of the k-th harmonic of values at even places around a circle, N.m or N.
double AmplitudeOf(int k, const std::vector<double>& values) {
  std::complex<double> sum = 0;
  const auto n = static_cast<double>(values.size());
  for (size_t i = 0; i < values.size(); ++i) {
    sum += std::polar(values[i], 2 * std::numbers::pi * k * static_cast<double>(i) / n);
  }
  return 2 * std::abs(sum) / n;
}

}  // namespace

void WidenUnresolved(const FrictionMap& motor, const LogSamples& m, double reach, MapBand& band) {
  const MapAxis* over_speed = FindAxis(motor, MapQuantity::velocity);
  if (motor.axes[0].quantity != MapQuantity::motor_position || !over_speed) return;
  const auto at = static_cast<size_t>(over_speed - motor.axes.data());
  const KernelLines lines(motor);
  const auto count = static_cast<size_t>(lines.length), stride = static_cast<size_t>(lines.stride);
  const double angle = m.gear * MedianStep(m.time);  // of a sample at 1 rad/s, rad

  // of each line its speed, and its values around the turn, before any is widened
  std::vector<double> speeds(stride);
  std::vector<std::vector<double>> values(stride);
  for (size_t j = 0; j < stride; ++j) {
    speeds[j] = band.points[j][at];
    for (size_t i = 0; i < count; ++i) values[j].push_back(band.value[i * stride + j]);
  }
  const auto phase = [&](size_t j, int k) { return k * angle * std::abs(speeds[j]); };
  // the line that shows how strong the k-th harmonic is: its own, or the slowest of its direction that shows it
  const auto shows = [&](size_t j, int k) {
    std::optional<size_t> slowest;
    for (size_t l = 0; l < stride; ++l) {
      if (!(speeds[l] * speeds[j] > 0 && phase(l, k) <= kShown)) continue;
      if (!slowest || std::abs(speeds[l]) < std::abs(speeds[*slowest])) slowest = l;
    }
    return phase(j, k) <= kShown ? std::optional(j) : slowest;
  };
  for (size_t j = 0; j < stride; ++j) {
    double variance = 0;
    for (int k = 1; 2 * k <= static_cast<int>(count); ++k) {
      const std::optional<size_t> line = shows(j, k);
      if (!line) continue;
      const double off = 2 * std::sin(std::min(phase(j, k), std::numbers::pi) / 2);
      variance += std::pow(off * AmplitudeOf(k, values[*line]), 2) / 2;
    }
    for (size_t i = j; i < count * stride; i += stride) {
      band.std[i] = std::hypot(band.std[i], std::sqrt(variance));
      band.interval95[i] = {band.value[i] - reach * band.std[i],
                            band.value[i] + reach * band.std[i]};
    }
  }
}

namespace {

/// The row a of the mean over the points of a group, or over one in so many of a large group. [p + q]
Eigen::RowVectorXd MeanOver(const std::vector<Index>& group, const Law& law, const MapFit& fit,
                            const MapPoints& kept) {
  const MapPoints points = Some(group, kept);
  const Eigen::MatrixXd columns = LawColumns(law, points.col(kVelocity));
  const Eigen::RowVectorXd kernels = MeanRow(fit.maps, points);
  // resistance is the force times the direction
  Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(fit.x.size());
  mean.head(columns.cols()) = columns.colwise().mean();
  mean.tail(kernels.size()) = kernels;
  return Sign(points(0, kVelocity)) * mean;
}

}  // namespace

std::vector<FrictionAtSpeed> FrictionAtSpeeds(const Law& law, const MapFit& fit,
                                              const Uncertainty& uncertainty,
                                              const MapPoints& kept) {
  const Eigen::MatrixXd covariance =
      uncertainty.covariance.topLeftCorner(fit.x.size(), fit.x.size());
  const double reach = StudentQuantile(uncertainty.degrees_of_freedom, kIntervalLevel);
  std::vector<FrictionAtSpeed> all;
  for (const SpeedGroup& group : TypicalSpeeds(kept.col(kVelocity))) {
    // linear in law and weights, so that its variance follows from their covariance
    const Eigen::RowVectorXd row = MeanOver(group.samples, law, fit, kept);
    const double value = row * fit.x;
    const double deviation = std::sqrt(std::max(0.0, double(row * covariance * row.transpose())));
    all.push_back(
        {group.velocity, value, deviation, {value - reach * deviation, value + reach * deviation}});
  }
  return all;
}

}  // namespace warmjoint
