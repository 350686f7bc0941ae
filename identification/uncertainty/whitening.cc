#include "identification/uncertainty/whitening.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>

#include "models/foundation/robust_noise.h"

namespace warmjoint {

namespace {

using Eigen::Index;

constexpr double kSure = 3;  // deviations; why 3: by chance once in 740
// why: if the sign turns with all of so few changes, that is as certain
constexpr double kFewestChanges = kSure * kSure;
constexpr Index kLongestGap = 1000;  // sampling intervals

/// Whether all samples of one recording are kept, at times that differ by less than half a step from an even clock, so that
/// each has one place.
bool AreNeighbours(const Selection& selection, const LogSamples& m) {
  const Index n = m.time.size();
  if (n < 2 || !m.further_starts.empty() || selection.count() != n) return false;
  const auto steps = m.time.tail(n - 1) - m.time.head(n - 1);
  return steps.maxCoeff() < 1.5 * steps.minCoeff();
}

/// The kept samples on an even grid of time: keep[i] is set where a sample has the place i.
Selection OnEvenGrid(const std::vector<Index>& places) {
  Selection grid;
  grid.keep.setConstant(places.empty() ? 0 : places.back() + 1, false);
  for (const Index place : places) grid.keep[place] = true;
  return grid;
}

}  // namespace

std::optional<bool> TurnsWithDirection(const Eigen::VectorXd& residual,
                                       const Eigen::VectorXd& velocity) {
  double changes = -1, turns = 0, before = 0;
  for (Index first = 0, last; first < residual.size(); first = last) {
    const bool forwards = velocity[first] > 0;
    last = first;
    while (last < residual.size() && (velocity[last] > 0) == forwards) ++last;
    // mean residual of a stretch in one direction, and whether it turned
    const double mean = residual.segment(first, last - first).mean();
    turns += before * mean < 0 ? 1 : 0;
    changes += 1;
    before = mean;
  }
  if (changes < kFewestChanges) return std::nullopt;
  // by chance the sign turns at half of the changes, with a standard deviation of sqrt(changes) / 2
  return turns - changes / 2 > kSure * std::sqrt(changes) / 2;
}

std::vector<Index> PlacesInTime(const LogSamples& m, const Selection& selection) {
  std::vector<Index> kept;
  for (Index i = 0; i < selection.keep.size(); ++i) {
    if (selection.keep[i]) kept.push_back(i);
  }
  std::vector<Index> places(kept.size(), 0);
  if (kept.size() < 2) return places;
  const double step = MedianStep(m.time(kept));
  size_t next = 0;
  for (size_t i = 1; i < kept.size(); ++i) {
    // in steps: most samples are one apart; gaps count as the longest distance
    const double apart = (m.time[kept[i]] - m.time[kept[i - 1]]) / step;
    Index further = 1;
    if (!(apart < static_cast<double>(kLongestGap))) {
      further = kLongestGap;
    } else if (apart >= 1.5) {
      further = std::llround(apart);
    }

    // no correlation reaches from one recording into the next
    while (next < m.further_starts.size() && m.further_starts[next] <= kept[i - 1]) ++next;
    if (next < m.further_starts.size() && m.further_starts[next] <= kept[i]) further = kLongestGap;
    places[i] = places[i - 1] + further;
  }
  return places;
}

Whitening::Whitening(NoiseModel noise, const std::vector<Index>& places)
    : noise_(std::move(noise)) {
  const auto p = static_cast<size_t>(noise_.order());

  // the distances of the places before each row: rows with the same ones have the same predictor
  std::map<std::vector<Index>, int> known;
  std::vector<std::vector<Index>> patterns;
  Index farthest = 0;
  std::vector<Index> lags;
  for (size_t i = 0; i < places.size(); ++i) {
    // distances to the samples that predict this one, each pattern of them solved once
    lags.clear();
    for (size_t j = i - std::min(i, p); j < i; ++j) lags.push_back(places[i] - places[j]);
    if (!lags.empty()) farthest = std::max(farthest, lags.front());
    const auto [at, fresh] = known.try_emplace(lags, static_cast<int>(patterns.size()));
    if (fresh) patterns.push_back(lags);
    which_.push_back(at->second);
  }

  // the predictor of each pattern
  const Eigen::VectorXd covariances = CovariancesOf(noise_, farthest);
  for (const auto& pattern : patterns) predictors_.push_back(Solve(pattern, covariances));
}

Whitening::Predictor Whitening::Solve(const std::vector<Index>& lags,
                                      const Eigen::VectorXd& covariances) const {
  const auto m = static_cast<Index>(lags.size());
  // autocovariances among the lags, and with the sample that they predict
  Eigen::MatrixXd among(m, m);
  Eigen::VectorXd with(m);
  for (Index i = 0; i < m; ++i) {
    const Index lag = lags[static_cast<size_t>(i)];
    with[i] = covariances[lag];
    for (Index j = 0; j < m; ++j) {
      among(i, j) = covariances[std::abs(lag - lags[static_cast<size_t>(j)])];
    }
  }
  // the linear prediction of least error, scaled to the error of the innovations
  Predictor predictor;
  predictor.weights = among.ldlt().solve(with).transpose();
  const double left = noise_.variance - predictor.weights.dot(with);
  predictor.scale = std::sqrt(noise_.innovation / std::max(left, noise_.innovation));
  return predictor;
}

void Whitening::Apply(Rows& rows) const {
  // from the last row on, so that the rows before it are not yet changed
  for (Index i = rows.rows() - 1; i >= 0; --i) {
    const Predictor& predictor = predictors_[static_cast<size_t>(which_[static_cast<size_t>(i)])];
    const Index m = predictor.weights.size();
    if (m > 0) rows.row(i).noalias() -= predictor.weights * rows.middleRows(i - m, m);
    rows.row(i) *= predictor.scale;
  }
}

std::shared_ptr<const Whitening> WhiteningFor(const Eigen::VectorXd& residual,
                                              const LogSamples& measurements,
                                              const Selection& selection) {
  // neighbours with white noise are the common case, for which no places are needed
  const bool neighbours = AreNeighbours(selection, measurements);
  if (neighbours && !IsSurelyColoured(FitNoise(residual, selection), residual.size()))
    return nullptr;
  const std::vector<Index> places = PlacesInTime(measurements, selection);
  const NoiseModel noise = FitNoise(residual, OnEvenGrid(places));
  if (!IsSurelyColoured(noise, residual.size())) return nullptr;
  const auto turns = TurnsWithDirection(residual, Chosen(measurements.velocity, selection.keep));
  if (!turns || *turns) return nullptr;
  return std::make_shared<const Whitening>(noise, places);
}

}  // namespace warmjoint
