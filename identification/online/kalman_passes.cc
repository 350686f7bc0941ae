#include "identification/online/kalman_passes.h"

#include <algorithm>
#include <cmath>

#include "identification/online/kalman_bank.h"

namespace warmjoint {
namespace {

constexpr Eigen::Index kMoments = 50;  // of the trace

/// Sample i.
template <int D>
KalmanSample<D> At(const KalmanTrack& track, Eigen::Index i) {
  const ClosedLoop& loop = track.loop;
  return {loop.levels().row(i).transpose(), loop.speed()[i],
          loop.direction()[i] * track.measurements.torque[i],
          track.selection.keep[i] && loop.speed()[i] > 0,
          loop.intervals().length[loop.intervals().which[i]]};
}

/// Variance of white noise on the level from its changes between the first neighbours: their median
/// does not mind the few at which the speed changes. (N.m)^2 or N^2.
double GuessNoise(const KalmanTrack& track) {
  constexpr Eigen::Index kFirst = 200;
  std::vector<double> squares;
  const Eigen::VectorXd level = track.loop.direction().cwiseProduct(track.measurements.torque);
  for (Eigen::Index i = 1; i < level.size() && squares.size() < kFirst; ++i) {
    if (track.selection.keep[i - 1] && track.selection.keep[i]) {
      squares.push_back(std::pow(level[i] - level[i - 1], 2));
    }
  }
  const double least = 1e-12 * track.torque_rms * track.torque_rms;
  if (squares.empty()) return std::max(0.01 * track.torque_rms * track.torque_rms, least);
  std::nth_element(squares.begin(), squares.begin() + squares.size() / 2, squares.end());
  constexpr double kMedianOfSquare = 0.4549364;  // why: of a standard normal number
  return std::max(squares[squares.size() / 2] / (2 * kMedianOfSquare), least);
}

/// Ignorance of all but E = 0: ten times what could stand for the whole torque, and gains up to
/// thirty times that of a loop at the brink, k |v| = 1.
template <int D>
KalmanPrior<D> Ignorance(const KalmanTrack& track) {
  const Eigen::Index d = track.column_rms.size();
  KalmanPrior<D> prior;
  prior.state.mean.setZero(d + 3);
  prior.state.covariance.setZero(d + 3, d + 3);
  // the law's parameters, then the gain
  for (Eigen::Index i = 0; i < d; ++i) {
    prior.state.covariance(i, i) = std::pow(10 * track.torque_rms / track.column_rms[i], 2);
  }
  prior.state.covariance(d, d) = std::pow(30 / track.loop.speed().maxCoeff(), 2);

  // where the time constant may lie, and how large the noise is at first
  const auto [shortest, longest] = TimeConstantRange(track);
  prior.shortest = shortest;
  prior.longest = longest;
  prior.noise = GuessNoise(track);
  return prior;
}

Iterate Note(const Eigen::VectorXd& mean, Eigen::Index sample, double rmse) {
  const Eigen::Index d = mean.size() - 3;
  Iterate iterate;
  iterate.iteration = static_cast<int>(sample);
  iterate.values.assign(mean.begin(), mean.begin() + d + 2);
  iterate.values.back() = std::exp(iterate.values.back());
  iterate.rmse = rmse;
  iterate.energy = mean[d + 2];
  return iterate;
}

/// One pass; in `trace`, moments on the way.
template <int D>
KalmanPass Pass(const KalmanTrack& track, const KalmanPrior<D>& prior,
                std::vector<Iterate>& trace) {
  trace.clear();
  KalmanBank<D> bank = MakeBank(prior);
  const Eigen::Index n = track.loop.size();
  for (Eigen::Index i = 0; i < n; ++i) {
    bank = BankStep(bank, At<D>(track, i));
    // some moments on the way
    if ((i + 1) % std::max<Eigen::Index>(n / kMoments, 1) != 0) continue;
    const Eigen::VectorXd mean = Merge(bank).mean;
    if (mean.allFinite()) trace.push_back(Note(mean, i + 1, std::sqrt(bank.noise)));
  }
  const KalmanState<D> all = Merge(bank);
  return {all.mean, all.covariance, Spacing(prior), bank.noise};
}

/// Whether the later pass changed next to nothing.
bool Settled(const KalmanPass& earlier, const KalmanPass& later) {
  const Eigen::Index p = later.mean.size() - 1;  // all but E
  const Eigen::ArrayXd moved = (later.mean - earlier.mean).head(p).cwiseAbs();
  return (moved <= 0.1 * later.covariance.diagonal().head(p).array().sqrt()).all();
}

/// Where the pass after `last` begins: linearised where that one ended, but next to ignorant, its
/// deviations ten times as great (what is counted twice narrows them by half a percent in the end).
template <int D>
KalmanPrior<D> Again(const KalmanPass& last) {
  const Eigen::Index p = last.mean.size() - 2;
  KalmanPrior<D> prior;
  prior.state.mean = last.mean;
  prior.state.mean[p + 1] = 0;
  prior.state.covariance.setZero(p + 2, p + 2);
  prior.state.covariance.topLeftCorner(p, p) = 100 * last.covariance.topLeftCorner(p, p);

  // members around the time constant
  const double reach = std::max(4 * std::sqrt(last.covariance(p, p)), last.spacing);
  prior.shortest = std::exp(last.mean[p] - reach);
  prior.longest = std::exp(last.mean[p] + reach);
  prior.noise = last.noise;
  return prior;
}

/// All passes: where each of them ended.
template <int D>
std::vector<KalmanPass> Run(const KalmanTrack& track, int passes, std::vector<Iterate>& trace) {
  KalmanPrior<D> prior = Ignorance<D>(track);
  std::vector<KalmanPass> known;
  for (int pass = 0; pass < passes; ++pass) {
    known.push_back(Pass(track, prior, trace));
    const KalmanPass& last = known.back();
    // a pass that went astray counts for nothing and ends them
    if (!last.mean.allFinite() || !last.covariance.allFinite()) {
      if (pass > 0) known.pop_back();
      break;
    }
    if (pass > 0 && Settled(known[pass - 1], last)) break;

    prior = Again<D>(last);
  }
  return known;
}

}  // namespace

std::array<double, 2> TimeConstantRange(const KalmanTrack& track) {
  const Eigen::VectorXd& time = track.measurements.time;
  const double total = time[time.size() - 1] - time[0];
  return {std::max(2 * track.loop.intervals().typical, total / 500), 5 * total};
}

std::vector<KalmanPass> RunPasses(const KalmanTrack& track, int most, std::vector<Iterate>& trace) {
  // a number of law parameters that the compiler knows, where it is a common one
  switch (track.column_rms.size()) {
    case 1:
      return Run<1>(track, most, trace);
    case 2:
      return Run<2>(track, most, trace);
    case 3:
      return Run<3>(track, most, trace);
    default:
      return Run<Eigen::Dynamic>(track, most, trace);
  }
}

}  // namespace warmjoint
