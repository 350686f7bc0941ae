#include "identification/preparation/local_motion.h"

#include <Eigen/QR>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>

#include "identification/preparation/position_noise.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// why each number has its value: tests/studies/preparation.md
constexpr Index kHalfWidths[] = {2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64};  // samples to each side
constexpr Index kWide = 6;           // from which half width on the degree is five
constexpr double kByChance = 1e-3;   // of windows whose polynomial fits, rejected by chance
constexpr double kJump = 0.1;        // of the acceleration's rms
constexpr double kBeyondMedian = 4;  // of the change over two samples
constexpr double kDeviations = 5;    // of the noise
constexpr double kEven = 1e-3;       // of the step by which evenly sampled times may differ

/// The fitted series, and which derivative of it is the acceleration.
struct Series {
  const VectorXd& values;
  Index derivative;  // 1 of a velocity, 2 of a position
  double noise;      // standard deviation of one value

  /// The degree of the polynomials. The velocity is of third degree, and in wide windows of fifth.
  Index Degree(Index half_width) const { return derivative + (half_width < kWide ? 2 : 4); }
};

/// The polynomial through the samples of one window.
struct Window {
  MatrixXd basis;  // [n x (degree + 1)] orthonormal
  VectorXd value;  // [n] weights of the samples in the velocity at the middle
  VectorXd slope;  // [n] the same of the acceleration
  double gain() const { return slope.norm(); }  // noise of the acceleration by that of a sample
};

/// time: [n] s, of the window's samples; middle: s.
Window WindowOf(const VectorXd& time, double middle, const Series& series) {
  // powers of the time from the middle, scaled to 1 at the ends of the window
  const Index degree = series.Degree(time.size() / 2);
  const double reach = (time.array() - middle).abs().maxCoeff();
  MatrixXd powers(time.size(), degree + 1);
  powers.col(0).setOnes();
  for (Index k = 1; k <= degree; ++k) {
    powers.col(k) = powers.col(k - 1).cwiseProduct((time.array() - middle).matrix() / reach);
  }
  // an orthonormal basis of them, and what turns values into coefficients
  const Eigen::HouseholderQR<MatrixXd> qr(powers);
  const MatrixXd basis = qr.householderQ() * MatrixXd::Identity(time.size(), powers.cols());
  const MatrixXd coefficients =
      qr.matrixQR().topRows(powers.cols()).triangularView<Eigen::Upper>().solve(basis.transpose());

  // a velocity is value and slope, a position slope and twice the square's coefficient
  if (series.derivative == 1) return {basis, coefficients.row(0), coefficients.row(1) / reach};
  return {basis, coefficients.row(1) / reach, 2 * coefficients.row(2) / (reach * reach)};
}

bool IsEven(const VectorXd& time, const SampleRange& piece, double step) {
  for (Index i = piece.first + 1; i < piece.first + piece.count; ++i) {
    if (std::abs(time[i] - time[i - 1] - step) > kEven * step) return false;
  }
  return true;
}

/// All windows of one width.
struct Scale {
  Index half_width;
  double gain;                // of an evenly sampled window
  double degrees_of_freedom;  // samples less coefficients
  VectorXd velocity;          // [N]
  VectorXd acceleration;      // [N]
  VectorXd squares;  // [N] that the polynomial leaves; infinite where a window does not fit in
};

Scale ScaleOf(const Measurements& m, const std::vector<SampleRange>& pieces, const Series& series,
              Index half_width) {
  // windows over even time stamps share one basis
  const Index n = 2 * half_width + 1;
  const double step = MedianStep(m.time);
  const VectorXd steps = step * VectorXd::LinSpaced(n, 0, static_cast<double>(n - 1));
  const Window even = WindowOf(steps, step * static_cast<double>(half_width), series);
  Scale scale{half_width,
              even.gain(),
              static_cast<double>(n - series.Degree(half_width) - 1),
              VectorXd::Zero(m.size()),
              VectorXd::Zero(m.size()),
              VectorXd::Constant(m.size(), std::numeric_limits<double>::infinity())};
  // each sample with a whole window around it
  for (const SampleRange& piece : pieces) {
    const bool is_even = IsEven(m.time, piece, step);
    for (Index i = piece.first + half_width; i + half_width < piece.first + piece.count; ++i) {
      const Window own =
          is_even ? Window() : WindowOf(m.time.segment(i - half_width, n), m.time[i], series);
      const Window& window = is_even ? even : own;

      // relative to the middle, so that a large position costs no digits
      const VectorXd y = series.values.segment(i - half_width, n).array() - series.values[i];
      const double middle = series.derivative == 1 ? series.values[i] : 0;
      scale.velocity[i] = middle + window.value.dot(y);
      scale.acceleration[i] = window.slope.dot(y);
      scale.squares[i] = (y - window.basis * (window.basis.transpose() * y)).squaredNorm();
    }
  }
  return scale;
}

/// Root mean square of the acceleration where it is known and the joint moves, less the noise's part.
double RmsOf(const Scale& scale, const SampleMask& moving, double noise) {
  const SampleMask known = scale.squares.array().isFinite() && moving;
  const auto count = static_cast<double>(std::max<Index>(known.count(), 1));
  const double mean = known.select(scale.acceleration.array().square(), 0).sum() / count;
  return std::sqrt(std::max(0.0, mean - noise * noise));
}

/// How much the acceleration differs from one side of each sample to the other; 0 where it is not known. [N]
VectorXd ChangesOf(const LocalMotion& motion, const std::vector<SampleRange>& pieces) {
  VectorXd changes = VectorXd::Zero(motion.acceleration.size());
  for (const auto& [first, count] : pieces) {
    for (Index i = first + 1; i + 1 < first + count; ++i) {
      if (!motion.known[i - 1] || !motion.known[i + 1]) continue;
      changes[i] = std::abs(motion.acceleration[i + 1] - motion.acceleration[i - 1]);
    }
  }
  return changes;
}

/// Root mean square of what steps of a piece differ from the median one, s.
double SpreadOfSteps(const VectorXd& time, const std::vector<SampleRange>& pieces) {
  const double step = MedianStep(time);
  double squares = 0, count = 0;
  for (const auto& [first, length] : pieces) {
    for (Index i = first + 1; i < first + length; ++i, ++count) {
      squares += std::pow(time[i] - time[i - 1] - step, 2);
    }
  }
  return count > 0 ? std::sqrt(squares / count) : 0;
}

/// Standard deviation of the time stamps from the moments of the samples, s, as polynomials through the positions show it where
/// stamps are uneven: they leave v^2 s^2 in addition to the noise of a position, in the median over samples in motion. No more
/// than the steps themselves spread; 0 of even stamps.
double StampNoise(const Measurements& m, const std::vector<SampleRange>& pieces, const Scale& scale,
                  double noise, const SampleMask& moving) {
  const double most = SpreadOfSteps(m.time, pieces);
  if (most <= kEven * MedianStep(m.time)) return 0;
  const SampleMask used = moving && scale.squares.array().isFinite();
  if (!used.any()) return 0;
  // the median of chi^2 over its mean (Wilson and Hilferty 1931)
  const double median = std::pow(1 - 2 / (9 * scale.degrees_of_freedom), 3);
  const VectorXd variance = scale.squares / (scale.degrees_of_freedom * median);
  const VectorXd ratio = (variance.array() - noise * noise) / m.velocity.array().square();
  return std::min(most, std::sqrt(std::max(0.0, MedianOf(Chosen(ratio, used)))));
}

}  // namespace

SampleMask InMotion(const VectorXd& velocity) {
  const double rms = std::sqrt(velocity.squaredNorm() / static_cast<double>(velocity.size()));
  return velocity.array().abs() >= kClear * rms;
}

SampleMask AwayFromCorners(const SampleMask& known, const VectorXd& changes,
                           const SampleMask& moving, double rms, double noise) {
  VectorXd ordered = Chosen(changes, moving);
  // a change beyond what smooth motion and noise make is a corner
  const double most =
      std::max({kJump * rms, kBeyondMedian * MedianInPlace(ordered), kDeviations * noise});
  const SampleMask straight = known && changes.array() <= most;
  SampleMask away = straight;
  // neighbours of a corner are left out as well
  const Index pairs = std::max<Index>(away.size() - 1, 0);
  away.head(pairs) = away.head(pairs) && straight.tail(pairs);
  away.tail(pairs) = away.tail(pairs) && straight.head(pairs);
  return away;
}

double StepOfVelocity(const VectorXd& velocity) {
  const double step = Resolution(velocity);
  if (step == 0) return 0;
  // changes that the next one repeats belong to a ramp, not to a resolution
  Index changes = 0, again = 0;
  for (Index i = 1; i + 1 < velocity.size(); ++i) {
    const double change = velocity[i] - velocity[i - 1];
    if (std::abs(change) < 0.5 * step) continue;
    ++changes;
    again += std::abs(velocity[i + 1] - velocity[i] - change) < 0.5 * step;
  }
  return 2 * again > changes ? 0 : step;
}

double NoiseOfVelocity(const VectorXd& velocity) {
  return std::max(WhiteNoise(velocity, InMotion(velocity)),
                  StepOfVelocity(velocity) / std::sqrt(12.0));
}

LocalMotion FollowLocally(const Measurements& m, const std::vector<SampleRange>& pieces,
                          MotionSource source) {
  const Series series = source == MotionSource::velocity
                            ? Series{m.velocity, 1, NoiseOfVelocity(m.velocity)}
                            : Series{m.position, 2, MeasurePositionNoise(m.position).deviation};
  const SampleMask moving = InMotion(m.velocity);

  // wider windows until noise no longer matters
  std::vector<Scale> scales;
  double rms = 0, stamps = 0, typical = series.noise;
  for (const Index half_width : kHalfWidths) {
    if (2 * half_width < series.Degree(half_width) + 1) continue;
    scales.push_back(ScaleOf(m, pieces, series, half_width));
    // positions at time stamps with an error s have an error v s, which is largest in the fastest half of the motion
    if (scales.size() == 1 && source == MotionSource::positions) {
      stamps = StampNoise(m, pieces, scales.back(), series.noise, moving);
      const VectorXd speed = Chosen(m.velocity, moving);
      const double square =
          speed.squaredNorm() / static_cast<double>(std::max<Index>(speed.size(), 1));
      typical = std::hypot(series.noise, stamps * std::sqrt(square));
    }
    const double noise = typical * scales.back().gain;
    rms = RmsOf(scales.back(), moving, noise);
    if (noise <= kAcceptedNoise * rms) break;
  }

  // each sample takes the widest window that nothing contradicts
  LocalMotion motion{m.velocity, VectorXd::Zero(m.size()), {}};
  motion.known.setConstant(m.size(), false);
  for (auto scale = scales.rbegin(); scale != scales.rend(); ++scale) {
    const double accepted = kAcceptedNoise * rms / scale->gain;
    // squares of a polynomial that follows the motion, beyond which chance rarely goes
    const double beyond = boost::math::quantile(
        boost::math::complement(boost::math::chi_squared(scale->degrees_of_freedom), kByChance));
    // the first window to pass is the widest, and it stays
    for (Index i = 0; i < m.size(); ++i) {
      const double noise = std::max(std::hypot(series.noise, stamps * m.velocity[i]), accepted);
      if (motion.known[i] || !(scale->squares[i] <= noise * noise * beyond)) continue;
      motion.known[i] = true;
      motion.velocity[i] = scale->velocity[i];
      motion.acceleration[i] = scale->acceleration[i];
    }
  }
  // through few samples a polynomial bends from one slope to the other within the noise
  motion.known = AwayFromCorners(motion.known, ChangesOf(motion, pieces), moving, rms,
                                 typical * scales.back().gain);
  return motion;
}

}  // namespace warmjoint
