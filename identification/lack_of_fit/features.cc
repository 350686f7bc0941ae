#include "identification/lack_of_fit/features.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "identification/lack_of_fit/rows_by_value.h"
#include "identification/linear/rigid_part.h"
#include "identification/sentences/findings.h"

namespace warmjoint {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kPi = std::numbers::pi;
constexpr int kPlaces = 32;           // parts of the recording, between which steps lie
constexpr Index kFirstCycles = 5;     // steps of kCyclesApart; why: the drift goes to two cycles
constexpr double kBinsACycle = 4;     // why: means over a quarter of a cycle keep 0.9 of it
constexpr double kCyclesApart = 0.5;  // why: a wave midway between two that are tried keeps 0.81

ArrayXd SignOf(const Bins& bins) { return bins.velocity.array().sign(); }

MatrixXd Signed(const Bins& bins, const MatrixXd& columns) {
  return SignOf(bins).matrix().asDiagonal() * columns;
}

/// Columns, and the same columns times s.
MatrixXd BothDirections(const Bins& bins, const MatrixXd& columns) {
  MatrixXd both(columns.rows(), 2 * columns.cols());
  both << columns, Signed(bins, columns);
  return both;
}

/// (|Z(k)|^2 + |Z(-k)|^2) / 2 for k < count, Z(k) the sum of z e^(-i k x): by a fast Fourier transform of z spread over even
/// cells by Gaussians (Greengard and Lee, SIAM Review 46, 2004, Eqs. 8 to 12), right to 12 digits of the largest.
/// x: [m] rad, 0 to pi
ArrayXd SquaresOfWaves(const ArrayXd& x, const std::vector<std::complex<double>>& z, Index count) {
  constexpr Index spread = 12;  // cells to each side; why: as many digits
  const auto cells = static_cast<Index>(std::bit_ceil(static_cast<size_t>(4 * count + spread)));
  const double width = 2 * kPi / static_cast<double>(cells);
  const double modes = 2 * static_cast<double>(count), finer = static_cast<double>(cells) / modes;
  const double tau = kPi * spread / (modes * modes * finer * (finer - 0.5));

  // each value into the cells around it: exp(-(a - l w)^2 / 4 tau), a its distance from a cell, in three factors
  const ArrayXd cell = ArrayXd::LinSpaced(2 * spread, 1 - spread, spread);
  const ArrayXd of_cell = (-(cell * width).square() / (4 * tau)).exp();
  std::vector<std::complex<double>> grid(static_cast<size_t>(cells)), spectrum;
  for (Index i = 0; i < x.size(); ++i) {
    const auto nearest = static_cast<Index>(x[i] / width);
    const double away = x[i] - static_cast<double>(nearest) * width;
    const double each = std::exp(away * width / (2 * tau));
    double of_value = std::exp(-away * away / (4 * tau)) * std::pow(each, 1 - spread);
    for (Index l = 0; l < 2 * spread; ++l, of_value *= each) {
      const Index at = (nearest + l + 1 - spread + cells) % cells;
      grid[static_cast<size_t>(at)] += of_value * of_cell[l] * z[static_cast<size_t>(i)];
    }
  }
  Eigen::FFT<double>().fwd(spectrum, grid);
  // corrects for the attenuation by the Gaussians
  ArrayXd squares(count);
  for (Index k = 0; k < count; ++k) {
    const auto at = static_cast<size_t>(k), opposite = static_cast<size_t>((cells - k) % cells);
    const double order = static_cast<double>(k);
    squares[k] = std::exp(2 * order * order * tau) *
                 (std::norm(spectrum[at]) + std::norm(spectrum[opposite]));
  }
  return squares * kPi / (2 * tau * static_cast<double>(cells * cells));
}

/// Which of the first `count` multiples of kCyclesApart over the log, from kFirstCycles on, explains most of what is left if it
/// covers it evenly.
double StrongestCycles(const Bins& bins, const GrowingFit& fit, Index count) {
  // forwards and backwards: as a force in one direction and as one against the motion it is sum and difference of
  // both, whose squares add up to twice those of both; one as real part, one as imaginary
  const VectorXd left = bins.weight.cwiseProduct(fit.Left());
  std::vector<std::complex<double>> directions;
  for (Index c = 0; c < bins.size(); ++c) {
    const bool backwards = bins.velocity[c] < 0;
    directions.emplace_back(backwards ? 0 : left[c], backwards ? left[c] : 0);
  }
  const ArrayXd step = 2 * kPi * kCyclesApart * bins.time.array();
  Index strongest = 0;
  SquaresOfWaves(step, directions, kFirstCycles + count).tail(count).maxCoeff(&strongest);
  return kCyclesApart * static_cast<double>(kFirstCycles + strongest);
}

}  // namespace

Features OfDirection(const Bins& bins, const Circumstances&, const GrowingFit&) {
  MatrixXd direction(bins.size(), 2);
  direction << VectorXd::Ones(bins.size()), bins.velocity.cwiseAbs();
  return {direction};
}

Features OfSpeed(const Bins& bins, const Circumstances&, const GrowingFit&) {
  const ArrayXd sign = SignOf(bins), speed = bins.velocity.array().abs();
  const ArrayXd u = speed / speed.maxCoeff();
  MatrixXd curve(bins.size(), 3);
  curve << (sign * u.square()).matrix(), (sign * (-u / 0.1).exp()).matrix(),
      (sign * (-u / 0.3).exp()).matrix();
  return {curve};
}

Features OfEnergy(const Bins& bins, const Circumstances& circumstances, const GrowingFit&) {
  return {Signed(bins, circumstances.energies)};
}

Features OfSpeedByEnergy(const Bins&, const Circumstances& circumstances, const GrowingFit&) {
  return {circumstances.heating.slope};
}

Features OfInitialEnergy(const Bins&, const Circumstances& circumstances, const GrowingFit&) {
  return {circumstances.initial};
}

Features OfLoad(const Bins& bins, const Circumstances& circumstances, const GrowingFit&) {
  return {ConcatColumns(Signed(bins, circumstances.loads),
                        circumstances.loads.leftCols(circumstances.loads.cols() / 2))};
}

Features OfGravity(const Bins&, const Circumstances& circumstances, const GrowingFit&) {
  return {circumstances.weight};
}

Features OfRecording(const Bins&, const Circumstances& circumstances, const GrowingFit&) {
  return {circumstances.by_recording};
}

Features OfTemperature(const Bins& bins, const Circumstances& circumstances, const GrowingFit&) {
  return {Signed(bins, circumstances.temperatures)};
}

Features OfTime(const Bins& bins, const Circumstances&, const GrowingFit&) {
  // cos k a by cos a: Chebyshev's polynomials
  const ArrayXd sign = SignOf(bins), first = (kPi * bins.time.array()).cos();
  const ArrayXd second = 2 * first.square() - 1;
  MatrixXd drift(bins.size(), 6);
  drift << (sign * first).matrix(), (sign * second).matrix(),
      (sign * first * (2 * second - 1)).matrix(), (sign * (2 * second.square() - 1)).matrix(),
      first.matrix(), second.matrix();
  return {drift};
}

Features OfSpeedMemory(const Bins& bins, const Circumstances& circumstances,
                       const GrowingFit& fit) {
  // without a warming in the fit, the heat would look like such friction, since it follows the speed late, too
  Features none{.columns = MatrixXd(bins.size(), 0)};
  if (circumstances.heating.slope.cols() == 0) none.absent = kNoWarming;
  if (circumstances.past.empty() || !none.absent.empty()) return none;
  const MatrixXd& all = circumstances.late_speeds;
  // the time constant that explains most in addition to the fit
  Index best = 0;
  fit.ExplainedBy(all).maxCoeff(&best);
  return {all.col(best), static_cast<int>(all.cols()),
          circumstances.past[static_cast<size_t>(best)]};
}

Features OfStep(const Bins& bins, const Circumstances&, const GrowingFit& fit) {
  // the number of places before each row, by the samples before it
  constexpr Index places = kPlaces - 1;
  std::vector<Index> passed;
  const double total = bins.weight.sum();
  double before = 0;
  for (const double weight : bins.weight) {
    passed.push_back(std::min(static_cast<Index>(before / total * kPlaces), places));
    before += weight;
  }

  // the one step, of the offset or of the friction, that explains most in addition to the fit
  const VectorXd offset = VectorXd::Ones(bins.size()), friction = SignOf(bins);
  VectorXd explained(2 * places);
  explained << fit.ExplainedBySteps(passed, places, offset),
      fit.ExplainedBySteps(passed, places, friction);
  Index best = 0;
  explained.maxCoeff(&best);
  VectorXd step = best < places ? offset : friction;
  for (Index i = 0; i < step.size(); ++i) {
    if (passed[static_cast<size_t>(i)] <= best % places) step[i] = 0;
  }
  return {step, static_cast<int>(explained.size())};
}

Features OfHoldParity(const Bins& bins, const Circumstances&, const GrowingFit&) {
  if (bins.hold.size() == 0) return {MatrixXd(bins.size(), 0)};
  // the phase advances by half a turn with each segment, which changes the sign of the waves
  const MatrixXd waves =
      RowsByValue(bins.phase, [](const ArrayXd& phases) { return Waves(kPi * phases); });
  MatrixXd parity(bins.size(), 3);
  for (Index i = 0; i < bins.size(); ++i) {
    const double sign = static_cast<Index>(bins.hold[i]) % 2 == 0 ? 1 : -1;
    parity(i, 0) = sign;
    parity.row(i).tail<2>() = sign * waves.row(i);
  }
  return {BothDirections(bins, parity)};
}

Features OfHoldPhase(const Bins& bins, const Circumstances&, const GrowingFit&) {
  if (bins.hold.size() == 0) return {MatrixXd(bins.size(), 0)};
  const MatrixXd waves = RowsByValue(
      bins.phase, [](const ArrayXd& phases) -> MatrixXd { return (2 * kPi * phases).cos(); });
  MatrixXd phase(bins.size(), 2);
  phase << (bins.phase.array() - 0.5).matrix(), waves;
  return {BothDirections(bins, phase)};
}

Features OfPeriod(const Bins& bins, const Circumstances& circumstances, const GrowingFit& fit) {
  // no more cycles than the bins resolve, or than one a hold
  const double most =
      std::min(static_cast<double>(bins.size()) / kBinsACycle,
               circumstances.hold > 0 ? circumstances.duration / circumstances.hold : kInfinity);
  const Index count = static_cast<Index>(most / kCyclesApart) - kFirstCycles + 1;
  if (count < 1) return {MatrixXd(bins.size(), 0)};
  const double cycles = StrongestCycles(bins, fit, count);
  return {BothDirections(bins, Waves(2 * kPi * cycles * bins.time.array())),
          static_cast<int>(count), circumstances.duration / cycles};
}

}  // namespace warmjoint
