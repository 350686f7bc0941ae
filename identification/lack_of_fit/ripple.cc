#include "identification/lack_of_fit/ripple.h"

#include <Eigen/LU>
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <optional>
#include <unsupported/Eigen/FFT>

#include "identification/fit/fit_data.h"
#include "identification/lack_of_fit/growing_fit.h"
#include "identification/lack_of_fit/rows_by_value.h"
#include "identification/lack_of_fit/table.h"
#include "models/foundation/robust_noise.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector4d;
using Eigen::VectorXd;

constexpr int kMost = 6;  // frequencies that are reported together
constexpr int kMotorHarmonics = 8;
constexpr double kFinestPosition = 512;  // cycles over the travel; why: twelve times a map's
constexpr double kSamplesACycle = 16;    // why: two samples a bin
constexpr int kSpeedFactors = 4;         // why: they distinguish five speeds
constexpr double kSpeedsDiffer = 0.02;   // relative; why: bins take closer speeds for one
constexpr double kBinsACycle = 8;        // why: a wave in eight steps has 95 % of its squares

/// An angle, or a distance, along which ripple is looked for.
struct AngleAxis {
  Eigen::VectorXd phase;  // [N] 0 to 1: place along the axis, or turn
  double length = 1;      // of the axis, in its own unit
  double step = 1;        // between frequencies, cycles along the axis
  int frequencies = 8;    // step, 2 step, ...
  /// [N] by which each sample's ripple is multiplied, as by a function of its speed; empty: by 1.
  Eigen::VectorXd factor{};
  int factors = 1;  // of which this one is tried

  double FactorOf(Eigen::Index n) const { return factor.size() > 0 ? factor[n] : 1; }
};

/// The residual of the kept samples by bins of the axis, separately for each direction and part.
class BinnedResidual {
 public:
  /// A kept sample.
  struct Sample {
    double value;   // the part of its residual that is left, N.m or N
    double factor;  // of its ripple
    int bin, part;  // of the axis, of the recording
    int direction;  // 0 forwards, 1 backwards
  };

  BinnedResidual(const AngleAxis& axis, const VectorXd& residual, const VectorXd& velocity,
                 const Selection& selection)
      : bins_(static_cast<Index>(
            std::bit_ceil(static_cast<unsigned>(kBinsACycle * axis.step * axis.frequencies)))),
        counts_(MatrixXd::Zero(bins_, 2)),
        taken_(MatrixXd::Zero(bins_, 2)) {
    // each kept sample into its bin, by direction and by part of the recording
    const Index n = selection.count();
    samples_.resize(static_cast<size_t>(n));
    double sums[2] = {0, 0};
    double* counts[2] = {counts_.col(0).data(), counts_.col(1).data()};
    auto next = samples_.begin();
    int part = 0;
    for (Index i = 0; i < residual.size(); ++i) {
      if (!selection.keep[i]) continue;
      const auto bin = static_cast<int>(Bin(axis.phase[i]));
      while ((next - samples_.begin()) * kParts >= (part + 1) * n) ++part;
      const int d = velocity[i] < 0;
      const double factor = axis.FactorOf(i);
      *next++ = {residual[i], factor, bin, part, d};
      counts[d][bin] += factor * factor;
      sums[d] += factor * residual[i];
    }

    // a level of each direction, or a slope, is not ripple
    for (int d = 0; d < 2; ++d) {
      numbers_[d] = counts_.col(d).sum();
      sums[d] /= std::max(numbers_[d], 1.0);
    }
    for (Sample& sample : samples_) sample.value -= sample.factor * sums[sample.direction];
  }

  Index bins() const { return bins_; }
  // of samples in a direction, by their squared factors
  double number(int d) const { return numbers_[d]; }
  const std::vector<Sample>& samples() const { return samples_; }              // in time
  Eigen::MatrixXd::ConstColXpr counts(int d) const { return counts_.col(d); }  // [bins] as number

  /// Sums over each bin, N.m or N. [bins x 2] forwards, backwards
  MatrixXd Totals() const {
    MatrixXd totals = MatrixXd::Zero(bins_, 2);
    double* total[2] = {totals.col(0).data(), totals.col(1).data()};
    for (const Sample& one : samples_) total[one.direction][one.bin] += one.factor * one.value;
    return totals;
  }

  /// Takes a wave of each direction off every sample. waves: [bins x 2]
  void TakeOff(const MatrixXd& waves) {
    for (Sample& one : samples_) one.value -= one.factor * waves(one.bin, one.direction);
    taken_ += waves;
  }

  /// All that was taken off a sample of factor 1, N.m or N.
  double Taken(double phase, double velocity) const { return taken_(Bin(phase), velocity < 0); }

 private:
  Index Bin(double phase) const {
    return std::min(static_cast<Index>(phase * static_cast<double>(bins_)), bins_ - 1);
  }

  Index bins_;
  std::vector<Sample> samples_;
  MatrixXd counts_;  // [bins x 2] forwards, backwards
  MatrixXd taken_;   // [bins x 2] N.m or N
  double numbers_[2] = {0, 0};
};

/// cos and sin of 2 pi f phase in the middle of each bin. [bins x 2]
MatrixXd WavesOver(Index bins, double frequency) {
  const double step = 2 * std::numbers::pi * frequency / static_cast<double>(bins);
  const auto last = static_cast<double>(bins - 1);
  return Waves(step * (Eigen::ArrayXd::LinSpaced(bins, 0, last) + 0.5));
}

/// The frequency that explains most if it covers the axis evenly, times the axis' step; 0 where none does. totals: of the bins
int StrongestFrequency(const AngleAxis& axis, const BinnedResidual& binned,
                       const MatrixXd& totals) {
  // followed by zeros, for steps below a cycle
  const auto length = static_cast<Index>(static_cast<double>(binned.bins()) / axis.step);
  VectorXd explained = VectorXd::Zero(axis.frequencies + 1);
  for (int d = 0; d < 2; ++d) {
    explained += 2 / std::max(binned.number(d), 1.0) *
                 PowerSpectrum(totals.col(d), length, axis.frequencies);
  }

  // the constant is no ripple
  explained[0] = 0;
  int strongest = 0;
  for (int k = 1; k <= axis.frequencies; ++k) {
    if (explained[k] > explained[strongest]) strongest = k;
  }
  return strongest;
}

/// One frequency, fitted, with its waves.
struct Ripple {
  Finding finding;
  MatrixXd waves;  // [bins x 2] forwards, backwards; N.m or N
};

/// Fits one frequency, each direction by itself. totals: of the bins
Ripple FitRipple(const AngleAxis& axis, int index, const BinnedResidual& binned,
                 const MatrixXd& totals) {
  Ripple ripple;
  ripple.waves.resize(binned.bins(), 2);
  const MatrixXd waves = WavesOver(binned.bins(), axis.step * index);
  MatrixXd normal = MatrixXd::Zero(4, 4);
  Vector4d score = Vector4d::Zero(), coefficients = Vector4d::Zero();
  for (int d = 0; d < 2; ++d) {
    // one of the directions may have no samples
    Eigen::Matrix2d own = waves.transpose() * binned.counts(d).asDiagonal() * waves;
    own.diagonal().array() += 1e-9 * (1 + own.trace());
    score.segment<2>(2 * d) = waves.transpose() * totals.col(d);
    coefficients.segment<2>(2 * d) = own.inverse() * score.segment<2>(2 * d);
    normal.block<2, 2>(2 * d, 2 * d) = own;
    ripple.waves.col(d) = waves * coefficients.segment<2>(2 * d);
  }

  // the scores of what is left, in each part of the recording
  MatrixXd scores = MatrixXd::Zero(4, kParts);
  for (const auto& [value, factor, bin, part, d] : binned.samples()) {
    const double rest = factor * (value - factor * ripple.waves(bin, d));
    scores(2 * d, part) += rest * waves(bin, 0);
    scores(2 * d + 1, part) += rest * waves(bin, 1);
  }
  constexpr double parts = kParts;
  const bool both = binned.number(0) > 0 && binned.number(1) > 0;
  const Index first = binned.number(0) > 0 ? 0 : 2, q = both ? 4 : 2;
  const MatrixXd scatter = parts / (parts - static_cast<double>(q)) * scores * scores.transpose();

  Finding& finding = ripple.finding;
  finding.made = true;
  // it is the strongest of many frequencies, so the probability is multiplied by their number
  finding.p = std::min(
      1.0, axis.frequencies * axis.factors *
               HotellingPValue(score.segment(first, q), scatter.block(first, first, q, q), parts));
  finding.explained = std::max(0.0, score.dot(coefficients) - (normal.inverse() * scatter).trace());
  finding.period = axis.length / (axis.step * index);

  // half sum and half difference of the directions
  const Eigen::Vector2d even = coefficients.head<2>() + coefficients.tail<2>();
  const Eigen::Vector2d odd = coefficients.head<2>() - coefficients.tail<2>();
  finding.alike = both ? even.squaredNorm() / (even.squaredNorm() + odd.squaredNorm()) : 0;
  return ripple;
}

std::optional<AngleAxis> MotorAxis(const LogSamples& m) {
  if (!KnowsMotorAngle(m)) return std::nullopt;
  AngleAxis axis{{}, 2 * std::numbers::pi, 1, kMotorHarmonics};
  const Eigen::ArrayXd turns = MotorPosition(m).array() / axis.length;
  axis.phase = turns - turns.floor();
  return axis;
}

/// The travel of the kept samples, down to periods of which half of the samples see two a period or more: at speeds that
/// differ, faster ones show them, too.
std::optional<AngleAxis> PositionAxis(const FittedModel& model, const LogSamples& m) {
  if (m.position_integrated) return std::nullopt;
  const Selection& selection = model.selection;
  const VectorXd kept = Kept(m.position, selection);
  VectorXd speeds = Kept(m.velocity, selection).cwiseAbs();
  const double lower = kept.minCoeff(), travel = kept.maxCoeff() - lower;
  const double finest = 2 * MedianInPlace(speeds) * model.step;
  if (!(travel > 0) || !std::isfinite(travel) || !(finest > 0)) return std::nullopt;

  // no more cycles than the speed and the number of samples can show
  const double cycles = std::min(
      {travel / finest, kFinestPosition, static_cast<double>(kept.size()) / kSamplesACycle});
  if (cycles < 1) return std::nullopt;
  AngleAxis axis{{}, travel, 0.5, static_cast<int>(2 * cycles)};
  axis.phase = (m.position.array() - lower) / travel;
  return axis;
}

/// cos(k pi r), k = 1 to kSpeedFactors, r: share of the kept samples that are slower. [N x kSpeedFactors]; without columns where
/// there is but one speed
MatrixXd SpeedFactors(const VectorXd& velocity, const Selection& selection) {
  VectorXd speeds = Kept(velocity, selection).cwiseAbs();
  std::ranges::sort(speeds);
  const auto n = static_cast<double>(speeds.size());
  const double slow = speeds[speeds.size() / 10],
               fast = speeds[speeds.size() - 1 - speeds.size() / 10];
  if (!(fast - slow > kSpeedsDiffer * fast)) return MatrixXd(velocity.size(), 0);
  MatrixXd factors(velocity.size(), kSpeedFactors);
  for (Index i = 0; i < velocity.size(); ++i) {
    const auto slower = std::ranges::lower_bound(speeds, std::abs(velocity[i])) - speeds.begin();
    const double angle = std::numbers::pi * static_cast<double>(slower) / n;
    for (int k = 0; k < kSpeedFactors; ++k) factors(i, k) = std::cos((k + 1) * angle);
  }
  return factors;
}

/// The axis along which a test looks; nothing where the log does not determine it.
std::optional<AngleAxis> AxisOf(const LackOfFitTest& test, const FittedModel& model,
                                const LogSamples& m) {
  return test.over == SeenOver::motor_angle ? MotorAxis(m) : PositionAxis(model, m);
}

/// The test along one axis, with one factor for each sample.
std::optional<Finding> TestAxis(const AngleAxis& axis, const VectorXd& velocity,
                                const Selection& selection, VectorXd& residual, ErrorLevel& level) {
  BinnedResidual binned(axis, residual, velocity, selection);
  std::optional<Finding> strongest;
  for (int i = 0; i < kMost; ++i) {
    const MatrixXd totals = binned.Totals();
    const int frequency = StrongestFrequency(axis, binned, totals);
    if (frequency == 0) break;
    Ripple ripple = FitRipple(axis, frequency, binned, totals);
    const bool rejects = level.WouldReject(ripple.finding);
    const double period = ripple.finding.period;
    if (!strongest) {
      strongest = std::move(ripple.finding);
    } else if (rejects) {
      // waves of one axis count as one finding, named by the strongest frequency
      strongest->explained += ripple.finding.explained;
    }
    if (!rejects) break;
    strongest->periods.push_back(period);
    binned.TakeOff(ripple.waves);
  }
  if (!strongest || !level.Rejects(*strongest)) return strongest;

  // the whole axis counts as one rejection, and all of its waves are subtracted from the residual
  for (Index i = 0; i < residual.size(); ++i) {
    if (!selection.keep[i]) continue;
    residual[i] -= axis.FactorOf(i) * binned.Taken(axis.phase[i], velocity[i]);
  }
  return strongest;
}

}  // namespace

VectorXd PowerSpectrum(const VectorXd& x, Index length, Index last) {
  VectorXd padded = VectorXd::Zero(length);
  padded.head(x.size()) = x;
  // one number is its own transform, which Eigen's is not made for
  if (length == 1) return padded.cwiseAbs2();
  // one transform a thread, which keeps its tables
  static thread_local Eigen::FFT<double> transform;
  Eigen::VectorXcd spectrum;
  transform.fwd(spectrum, padded);
  return spectrum.head(last + 1).cwiseAbs2();
}

std::optional<Finding> TestRipple(const LackOfFitTest& test, const FittedModel& model,
                                  const LogSamples& m, VectorXd& residual, ErrorLevel& level) {
  const std::optional<AngleAxis> axis = AxisOf(test, model, m);
  if (!axis) return std::nullopt;
  return TestAxis(*axis, m.velocity, model.selection, residual, level);
}

std::optional<Finding> TestRippleBySpeed(const LackOfFitTest& test, const FittedModel& model,
                                         const LogSamples& m, VectorXd& residual,
                                         ErrorLevel& level) {
  const bool is_motor = test.over == SeenOver::motor_angle;
  const MapQuantity angle = is_motor ? MapQuantity::motor_position : MapQuantity::position;
  if (std::ranges::find(model.mapped, angle) == model.mapped.end()) return std::nullopt;
  std::optional<AngleAxis> axis = AxisOf(test, model, m);
  if (!axis) return std::nullopt;

  // all functions of the speed count as one finding, that of the strongest
  const MatrixXd factors = SpeedFactors(m.velocity, model.selection);
  axis->factors = static_cast<int>(factors.cols());
  std::optional<Finding> strongest;
  double explained = 0;
  for (const auto& factor : factors.colwise()) {
    axis->factor = factor;
    ErrorLevel own = level;
    std::optional<Finding> one = TestAxis(*axis, m.velocity, model.selection, residual, own);
    if (!one) continue;
    if (one->rejected) explained += one->explained;
    if (!strongest || one->p < strongest->p) strongest = std::move(one);
  }
  if (strongest && level.Rejects(*strongest)) strongest->explained = explained;
  return strongest;
}

std::optional<Finding> TestFading(const LackOfFitTest&, const FittedModel& model, const LogSamples&,
                                  VectorXd& residual, ErrorLevel& level) {
  if (!model.maps || !model.thermal) return std::nullopt;

  // in addition to maps whose strength is free
  const Selection& selection = model.selection;
  const MatrixXd maps = Kept(*model.maps, selection);
  const VectorXd left = Kept(residual, selection);
  const Features steady{maps}, fading{maps.cwiseProduct(Kept(model.energy, selection))};
  GrowingFit fit({VectorXd::Ones(left.size()), Kept(model.derivatives, selection)}, left,
                 selection);
  fit.LearnNoise({steady, fading});
  fit.Take(steady);
  Finding finding = fit.Test(fading);
  if (!level.Rejects(finding)) return finding;

  // taken off the residual
  fit.Take(fading);
  const VectorXd explained = fit.Explained();
  Index row = 0;
  for (Index i = 0; i < residual.size(); ++i) {
    if (selection.keep[i]) residual[i] -= explained[row++];
  }
  return finding;
}

}  // namespace warmjoint
