#include "identification/lack_of_fit/rounding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "identification/fit/fit_data.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

using Eigen::ArrayXd;
using Eigen::VectorXd;
using std::numbers::pi;

constexpr double kEven = 1e-6;  // of a step: an error that does not matter
// of a step: noise that shows the torque within it; why: rounding.h
constexpr double kTells = 0.14;
constexpr int kFewestSteps = 3;  // why: whole multiples of one, to 5 %, by chance in 1 of 100
constexpr double kExact = 1e-5;  // of the largest; why: texts have six digits
constexpr int kMostWaves = 50;   // then the next is below 1 % of a step
constexpr int kHalvings = 30;    // of the noise that is looked for; why: to 1e-9 of it

/// The largest number that both are multiples of, to `exact`, by Euclid. a, b: at least 0
double CommonDivisor(double a, double b, double exact) {
  while (b > exact) a = std::exchange(b, std::abs(std::remainder(a, b)));
  return a;
}

/// E_k. noise: s/q
double Evened(int k, double noise) { return std::exp(-2 * std::pow(pi * k * noise, 2)); }

/// Means of (-1)^k cos(2 pi k f/q) for k = 1, 2, ... [kMostWaves]
std::array<double, kMostWaves> MeanWaves(const ArrayXd& place) {
  const ArrayXd cosine = -(2 * pi * place).cos();
  std::array<double, kMostWaves> means;
  ArrayXd before = ArrayXd::Ones(place.size()), wave = cosine;
  for (double& mean : means) {
    mean = wave.mean();
    // cos((k + 1) x) = 2 cos(x) cos(k x) - cos((k - 1) x)
    ArrayXd next = 2 * cosine * wave - before;
    before = std::move(wave);
    wave = std::move(next);
  }
  return means;
}

/// s/q of torques at these places with this mean square error, in steps.
double NoiseOf(const ArrayXd& place, double mean_square) {
  const std::array<double, kMostWaves> waves = MeanWaves(place);
  const auto made_by = [&](double noise) {
    double square = noise * noise + 1.0 / 12;
    for (int k = 1; k <= kMostWaves; ++k) {
      const double of_wave = 1 / std::pow(pi * k, 2) + 4 * noise * noise;
      square += waves[static_cast<std::size_t>(k - 1)] * of_wave * Evened(k, noise);
    }
    return square;
  };
  // the square grows with the noise
  double least = 0, most = 1 + std::sqrt(mean_square);
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (least + most) / 2;
    (made_by(middle) < mean_square ? least : most) = middle;
  }
  return least;
}

/// s/q by how often two neighbours lie on either side of an edge between steps: white noise far below q makes that in a share
/// 2 s/(q sqrt(pi)) of them, of torques that lie anywhere in a step. Motion adds to that.
double NoiseByNeighbours(const VectorXd& torque, double step) {
  const Eigen::Index pairs = torque.size() - 1;
  const ArrayXd changes = (torque.tail(pairs) - torque.head(pairs)).array().abs() / step;
  const auto count = static_cast<double>((changes > 0.5).count());
  return 0.5 * std::sqrt(pi) * count / static_cast<double>(pairs);
}

}  // namespace

double StepOf(const VectorXd& torque) {
  if (const double step = Resolution(torque); step > 0) return step;
  // where noise is hidden in a step, most neighbours repeat; in any other log the values need not be sorted
  const Eigen::Index others = torque.size() - 1;
  if (2 * (torque.tail(others).array() == torque.head(others).array()).count() < others) return 0;
  VectorXd sizes = VectorXd::Zero(torque.size() + 1);
  sizes.tail(torque.size()) = torque.cwiseAbs();
  std::ranges::sort(sizes);
  const auto logged = sizes.tail(torque.size());
  if ((logged.tail(others).array() > logged.head(others).array()).count() >= kFewestSteps) {
    return Resolution(logged);
  }
  // fewer are, to 5 %, multiples of a step by chance
  const double exact = kExact * sizes[others + 1];
  double step = 0;
  for (const double size : sizes) step = CommonDivisor(step, size, exact);
  return step > 10 * exact ? step : 0;
}

RoundedTorque::RoundedTorque(const VectorXd& torque, const VectorXd& residual,
                             const Selection& selection)
    : step_(StepOf(torque)) {
  if (step_ == 0) return;
  place_ = (torque - residual).array() / step_ - torque[0] / step_;
  const VectorXd kept = Kept(residual, selection) / step_;
  const double square = kept.squaredNorm() / static_cast<double>(kept.size());
  noise_ = NoiseOf(Kept(place_.matrix(), selection), square);
  of_neighbours_ = NoiseByNeighbours(torque, step_);
}

bool RoundedTorque::IsEven() const { return step_ == 0 || Evened(1, noise_) / pi < kEven; }

bool RoundedTorque::IsHidden() const {
  return step_ > 0 && std::min(noise_, of_neighbours_) < kTells;
}

VectorXd RoundedTorque::MeanError() const {
  ArrayXd error = ArrayXd::Zero(place_.size());
  double sign = -1;
  for (int k = 1; k <= kMostWaves; ++k, sign = -sign) {
    const double size = Evened(k, noise_) / (pi * k);
    if (size < kEven) break;
    error += sign * step_ * size * (2 * pi * k * place_).sin();
  }
  return error;
}

}  // namespace warmjoint
