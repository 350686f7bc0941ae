#include "identification/lack_of_fit/ripple.h"

#include <Eigen/LU>
#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <unsupported/Eigen/FFT>

#include "identification/fit_data.h"
#include "identification/lack_of_fit/significance.h"
#include "models/foundation/robust_noise.h"
#include "models/recording/motor_angle.h"

namespace warmjoint::inline identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector4d;
using Eigen::VectorXd;

constexpr int kMost = 6;  // frequencies that are reported together
constexpr int kMotorHarmonics = 8;
constexpr double kFinestPosition = 512;  // cycles over the travel; why: twelve times a map's
constexpr double kSamplesACycle = 16;    // why: two samples a bin
constexpr double kBinsACycle = 8;        // why: a wave in eight steps has 95 % of its squares

/// Sums of the residual and of samples over bins of the axis, apart for each direction and part.
class BinnedResidual {
 public:
  BinnedResidual(const AngleAxis& axis, const VectorXd& residual, const VectorXd& velocity,
                 const Selection& selection)
      : bins_(static_cast<Index>(
            std::bit_ceil(static_cast<unsigned>(kBinsACycle * axis.step * axis.frequencies)))),
        taken_(MatrixXd::Zero(bins_, 2)) {
    const auto n = static_cast<double>(selection.count());
    for (int d = 0; d < 2; ++d) {
      sums_[d].setZero(bins_, kParts);
      counts_[d].setZero(bins_, kParts);
    }

    // each kept sample into its bin, by direction and by part of the recording
    Index row = 0;
    for (Index i = 0; i < residual.size(); ++i) {
      if (!selection.keep[i]) continue;
      const Index bin = Bin(axis.phase[i]);
      const auto part = static_cast<Index>(static_cast<double>(row++) / n * kParts);
      const int d = velocity[i] < 0;
      sums_[d](bin, part) += residual[i];
      counts_[d](bin, part) += 1;
      squares_ += residual[i] * residual[i];
    }
    variance_ = squares_ / n;

    // a level of each direction is no ripple
    for (int d = 0; d < 2; ++d) {
      samples_[d] = counts_[d].sum();
      if (samples_[d] > 0) sums_[d] -= sums_[d].sum() / samples_[d] * counts_[d];
    }
  }

  Index bins() const { return bins_; }
  double variance() const { return variance_; }
  double samples(int d) const { return samples_[d]; }
  VectorXd Total(int d) const { return sums_[d].rowwise().sum(); }
  const MatrixXd& counts(int d) const { return counts_[d]; }
  const MatrixXd& sums(int d) const { return sums_[d]; }

  /// Takes a wave [bins] off every sample of direction d.
  void TakeOff(int d, const VectorXd& wave) {
    sums_[d] -= wave.asDiagonal() * counts_[d];
    taken_.col(d) += wave;
  }

  /// All that was taken off a sample, N.m or N.
  double Taken(double phase, double velocity) const { return taken_(Bin(phase), velocity < 0); }

 private:
  Index Bin(double phase) const {
    return std::min(static_cast<Index>(phase * static_cast<double>(bins_)), bins_ - 1);
  }

  Index bins_;
  MatrixXd sums_[2];    // [bins x parts] N.m or N; forwards, backwards
  MatrixXd counts_[2];  // [bins x parts]
  MatrixXd taken_;      // [bins x 2] N.m or N
  double samples_[2] = {0, 0};
  double squares_ = 0;
  double variance_ = 0;
};

/// The frequency that explains most if it covers the axis evenly, and how much.
struct Peak {
  int index = 0;  // times the axis' step
  double explained = 0;
};

/// cos and sin of 2 pi f phase in the middle of each bin. [bins x 2]
MatrixXd Waves(double frequency, Index bins) {
  MatrixXd waves(bins, 2);
  for (Index b = 0; b < bins; ++b) {
    const double phase = 2 * std::numbers::pi * frequency * (static_cast<double>(b) + 0.5) /
                         static_cast<double>(bins);
    waves(b, 0) = std::cos(phase);
    waves(b, 1) = std::sin(phase);
  }
  return waves;
}

Peak StrongestFrequency(const AngleAxis& axis, const BinnedResidual& binned) {
  // both directions in one transform: forwards + i backwards, with zeros behind for steps below a cycle
  const VectorXd forwards = binned.Total(0), backwards = binned.Total(1);
  const auto length = static_cast<size_t>(static_cast<double>(binned.bins()) / axis.step);
  std::vector<std::complex<double>> sums(length), waves;
  for (Index b = 0; b < binned.bins(); ++b) {
    sums[static_cast<size_t>(b)] = {forwards[b], backwards[b]};
  }
  Eigen::FFT<double>().fwd(waves, sums);

  // the transform at k and at -k together tells the directions apart
  Peak peak;
  for (int k = 1; k <= axis.frequencies; ++k) {
    const std::complex<double> wave = waves[static_cast<size_t>(k)];
    const std::complex<double> mirrored = std::conj(waves[length - static_cast<size_t>(k)]);
    const double explained =
        2 * (std::norm(0.5 * (wave + mirrored)) / std::max(binned.samples(0), 1.0) +
             std::norm(0.5 * (wave - mirrored)) / std::max(binned.samples(1), 1.0));
    if (explained > peak.explained) peak = {k, explained};
  }
  return peak;
}

/// One frequency, fitted, with its waves.
struct Ripple {
  Finding finding;
  VectorXd waves[2];  // [bins] forwards, backwards; N.m or N
};

/// Fits one frequency, each direction by itself.
Ripple FitRipple(const AngleAxis& axis, int index, const BinnedResidual& binned) {
  const MatrixXd waves = Waves(axis.step * index, binned.bins());
  MatrixXd scores = MatrixXd::Zero(4, kParts);
  MatrixXd normal = MatrixXd::Zero(4, 4);
  Vector4d score = Vector4d::Zero(), coefficients = Vector4d::Zero();
  for (int d = 0; d < 2; ++d) {
    // the other direction may not be there at all
    const VectorXd count = binned.counts(d).rowwise().sum();
    Eigen::Matrix2d own = waves.transpose() * count.asDiagonal() * waves;
    own.diagonal().array() += 1e-9 * (1 + own.trace());
    score.segment<2>(2 * d) = waves.transpose() * binned.Total(d);
    coefficients.segment<2>(2 * d) = own.inverse() * score.segment<2>(2 * d);
    normal.block<2, 2>(2 * d, 2 * d) = own;
    // the scores of what is left, in each part of the recording
    const VectorXd wave = waves * coefficients.segment<2>(2 * d);
    const MatrixXd rest = binned.sums(d) - wave.asDiagonal() * binned.counts(d);
    scores.middleRows<2>(2 * d) = waves.transpose() * rest;
  }
  constexpr double parts = kParts;
  const bool both = binned.samples(0) > 0 && binned.samples(1) > 0;
  const Index first = binned.samples(0) > 0 ? 0 : 2, q = both ? 4 : 2;
  const MatrixXd scatter = parts / (parts - static_cast<double>(q)) * scores * scores.transpose();

  Ripple ripple;
  Finding& finding = ripple.finding;
  finding.test = axis.test;
  finding.made = true;
  // the strongest of many frequencies: each of them counts
  finding.p =
      std::min(1.0, axis.frequencies * HotellingPValue(score.segment(first, q),
                                                       scatter.block(first, first, q, q), parts));
  finding.explained = std::max(0.0, score.dot(coefficients) - (normal.inverse() * scatter).trace());
  finding.period = axis.length / (axis.step * index);

  // half sum and half difference of the directions
  const Eigen::Vector2d even = coefficients.head<2>() + coefficients.tail<2>();
  const Eigen::Vector2d odd = coefficients.head<2>() - coefficients.tail<2>();
  finding.alike = both ? even.squaredNorm() / (even.squaredNorm() + odd.squaredNorm()) : 0;
  for (int d = 0; d < 2; ++d) ripple.waves[d] = waves * coefficients.segment<2>(2 * d);
  return ripple;
}

std::optional<AngleAxis> MotorAxis(const Measurements& m) {
  if (!KnowsMotorAngle(m)) return std::nullopt;
  AngleAxis axis{&MotorAngleTest(), {}, 2 * std::numbers::pi, 1, kMotorHarmonics};
  const Eigen::ArrayXd turns = MotorPosition(m).array() / axis.length;
  axis.phase = turns - turns.floor();
  return axis;
}

/// The travel of the kept samples, down to periods of which half of the samples see two a period or more: at speeds that
/// differ, faster ones tell them, too.
std::optional<AngleAxis> PositionAxis(const Measurements& m, const Selection& selection) {
  const VectorXd kept = Kept(m.position, selection);
  VectorXd speeds = Kept(m.velocity, selection).cwiseAbs();
  const double lower = kept.minCoeff(), travel = kept.maxCoeff() - lower;
  const double finest = 2 * MedianInPlace(speeds) * MedianStep(m.time);
  if (!(travel > 0) || !std::isfinite(travel) || !(finest > 0)) return std::nullopt;

  // no more cycles than the speed and the number of samples let one see
  const double cycles = std::min(
      {travel / finest, kFinestPosition, static_cast<double>(kept.size()) / kSamplesACycle});
  if (cycles < 1) return std::nullopt;
  AngleAxis axis{&PositionTest(), {}, travel, 0.5, static_cast<int>(2 * cycles)};
  axis.phase = (m.position.array() - lower) / travel;
  return axis;
}

}  // namespace

Finding TestAxis(const AngleAxis& axis, const VectorXd& velocity, const Selection& selection,
                 VectorXd& residual, ErrorLevel& level) {
  BinnedResidual binned(axis, residual, velocity, selection);
  Finding finding;
  for (int i = 0; i < kMost; ++i) {
    const Peak peak = StrongestFrequency(axis, binned);
    if (peak.index == 0) break;
    Ripple ripple = FitRipple(axis, peak.index, binned);
    ripple.finding.p_adjusted = level.Adjusted(ripple.finding.p);
    const bool rejects = ripple.finding.explained > 0 && level.WouldReject(ripple.finding.p);
    if (i == 0) finding = ripple.finding;
    if (!rejects) break;

    // of one axis as one: the strongest frequency stands for all
    if (i > 0) finding.explained += ripple.finding.explained;
    finding.rejected = true;
    for (int d = 0; d < 2; ++d) binned.TakeOff(d, ripple.waves[d]);
  }
  if (!finding.rejected) return finding;

  // one rejection for the whole axis, and all of its waves off the residual
  level.Rejects(finding.p);
  for (Index i = 0; i < residual.size(); ++i) {
    if (selection.keep[i]) residual[i] -= binned.Taken(axis.phase[i], velocity[i]);
  }
  return finding;
}

std::vector<Finding> TestRipple(const FittedModel& model, const Measurements& m, VectorXd& residual,
                                ErrorLevel& level) {
  std::vector<Finding> findings;
  for (const auto& axis : {MotorAxis(m), PositionAxis(m, model.selection)}) {
    if (!axis) continue;
    Finding finding = TestAxis(*axis, m.velocity, model.selection, residual, level);
    if (finding.test) findings.push_back(std::move(finding));
  }
  return findings;
}

}  // namespace warmjoint::inline identification
