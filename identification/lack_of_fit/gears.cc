#include "identification/lack_of_fit/gears.h"

#include <algorithm>
#include <bit>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <numbers>

#include "identification/lack_of_fit/ripple.h"
#include "identification/uncertainty/tails.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int kLeast = 30, kMost = 160;  // why: harmonic and strain wave gears of robots
constexpr int kHarmonics = 20;           // why: real waves are up to 18 times the gear
constexpr int kFiner = 4;        // frequencies a cycle over the travel; why: 5 % of a peak are lost
constexpr int kNeighbours = 25;  // cycles to each side; why: a median of fifty is within a fifth
constexpr double kBinsACycle = 8;  // why: a wave in eight steps has 95 % of its squares
// of log R by chance, for one direction or two; why: by integration over the density of Gamma(m)
constexpr double kScatter = 0.56;

/// The power of a residual over waves a turn, in units in which chance gives Gamma(directions).
struct Spectrum {
  VectorXd power;   // [n] at 0, step, 2 step, ...
  double step = 1;  // waves a turn
  Index reach = 0;  // to each side, in which a wave is found
  int directions = 0;
};

/// Sums of a residual over bins of a place, 0 to 1, in one direction. [bins]
VectorXd TotalsOf(const VectorXd& phase, const VectorXd& velocity, const VectorXd& residual,
                  double direction, Index bins) {
  VectorXd totals = VectorXd::Zero(bins);
  const Eigen::ArrayXd takes = (velocity.array() * direction > 0).cast<double>();
  const double mean = (residual.array() * takes).sum() / std::max(takes.sum(), 1.0);
  for (Index i = 0; i < phase.size(); ++i) {
    if (takes[i] == 0) continue;
    const auto bin = static_cast<Index>(phase[i] * static_cast<double>(bins));
    totals[std::min(bin, bins - 1)] += residual[i] - mean;
  }
  return totals;
}

/// The median of the values within a distance of each one. [n]
VectorXd LocalMedians(const VectorXd& values, Index distance) {
  VectorXd medians(values.size());
  for (Index i = 0; i < values.size(); ++i) {
    const Index first = std::max<Index>(i - distance, 0);
    const Index last = std::min(i + distance, values.size() - 1);
    VectorXd near = values.segment(first, last - first + 1);
    medians[i] = MedianInPlace(near);
  }
  return medians;
}

/// A travel of more than a turn is folded into one, over which a gear has whole numbers of waves.
Spectrum SpectrumOf(const VectorXd& position, const VectorXd& velocity, const VectorXd& residual,
                    double step) {
  constexpr double turn = 2 * std::numbers::pi;
  const double lower = position.minCoeff(), travel = position.maxCoeff() - lower;
  VectorXd speeds = velocity.cwiseAbs();
  // half of the samples see two a wave
  const double finest = turn / (2 * MedianInPlace(speeds) * step);
  const double highest = std::min(finest, static_cast<double>(kHarmonics * kMost) + 1);
  if (!(travel > 0) || !std::isfinite(travel) || !(highest > kLeast)) return {};

  const bool folds = travel > turn;
  const double length = std::min(travel, turn);
  const int finer = folds ? 1 : kFiner;
  Spectrum found;
  found.step = turn / length / finer;
  found.reach = folds ? 0 : 1;
  const auto bins = static_cast<Index>(
      std::bit_ceil(static_cast<unsigned>(std::ceil(kBinsACycle * highest * length / turn))));
  const auto last = static_cast<Index>(highest / found.step);
  const Eigen::ArrayXd places = (position.array() - lower) / length;
  const VectorXd phase = folds ? places - places.floor() : places;

  // each direction by itself, in units of its noise
  VectorXd power = VectorXd::Zero(last + 1);
  for (const double direction : {1.0, -1.0}) {
    const auto number = static_cast<double>((velocity.array() * direction > 0).count());
    if (number < 2) continue;
    ++found.directions;
    power +=
        PowerSpectrum(TotalsOf(phase, velocity, residual, direction, bins), bins * finer, last) /
        number;
  }
  if (found.directions == 0) return {};
  const VectorXd medians = LocalMedians(power, kNeighbours * finer);
  const double middle = boost::math::gamma_p_inv(static_cast<double>(found.directions), 0.5);
  found.power = middle * power.array() / medians.array().max(1e-300);
  return found;
}

/// log R.
double LogRatio(double y, int directions) {
  const double order = directions + 1, at = std::max(y, 1e-6);
  return std::log(boost::math::tgamma_lower(order, at)) - order * std::log(at) + at;
}

struct Score {
  int gear = 0;
  double value = 0;
  int waves = 0;  // that the log can show
};

Score ScoreOf(int gear, const Spectrum& spectrum) {
  const double most = std::log(kHarmonics * (kMost - kLeast + 1.0));
  Score score{gear};
  for (int k = 1; k <= kHarmonics; ++k) {
    const auto at = static_cast<Index>(std::lround(k * gear / spectrum.step));
    if (at + spectrum.reach >= spectrum.power.size()) break;
    const double y = spectrum.power.segment(at - spectrum.reach, 2 * spectrum.reach + 1).maxCoeff();
    score.value += std::min(LogRatio(y, spectrum.directions), most);
    ++score.waves;
  }
  return score;
}

}  // namespace

std::vector<int> GearsOf(const VectorXd& position, const VectorXd& velocity,
                         const VectorXd& residual, double step) {
  if (position.size() == 0) return {};
  const Spectrum spectrum = SpectrumOf(position, velocity, residual, step);
  if (spectrum.power.size() == 0) return {};
  std::vector<Score> scores;
  for (int gear = kLeast; gear <= kMost; ++gear) scores.push_back(ScoreOf(gear, spectrum));
  std::ranges::stable_sort(scores, std::greater(), &Score::value);

  // by Markov's inequality a ratio of x has a probability of 1/x at most; of all gears, one in twenty names one by chance
  const Score& best = scores.front();
  if (best.value < std::log(20.0 * static_cast<double>(scores.size()))) return {};
  const double chance = kNormal95 * std::sqrt(2.0 * best.waves) * kScatter;
  std::vector<int> gears;
  for (const Score& one : scores) {
    if (one.value >= best.value - chance) gears.push_back(one.gear);
  }
  return gears;
}

}  // namespace warmjoint
