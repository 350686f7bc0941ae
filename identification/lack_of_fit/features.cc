#include "identification/lack_of_fit/features.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "identification/lack_of_fit/rows_by_value.h"
#include "identification/linear/rigid_part.h"

namespace warmjoint {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kPi = std::numbers::pi;
constexpr int kPlaces = 32;           // parts that steps lie between
constexpr Index kFirstCycles = 5;     // steps of kCyclesApart; why: the drift goes to two cycles
constexpr double kBinsACycle = 4;     // why: means over a quarter of a cycle keep 0.9 of it
constexpr double kCyclesApart = 0.5;  // why: a wave midway between two that are tried keeps 0.81

ArrayXd SignOf(const Bins& bins) { return bins.velocity.array().sign(); }

MatrixXd Signed(const Bins& bins, const MatrixXd& columns) {
  return SignOf(bins).matrix().asDiagonal() * columns;
}

/// Columns and the same times s.
MatrixXd BothDirections(const Bins& bins, const MatrixXd& columns) {
  MatrixXd both(columns.rows(), 2 * columns.cols());
  both << columns, Signed(bins, columns);
  return both;
}

/// Waves of values at some times, each of which turns by its own step.
struct TurningWaves {
  std::vector<double> cosine, sine;            // [m] of the values
  std::vector<double> turn_cosine, turn_sine;  // [m] of the steps

  /// Square of the sum of all, which then turn by a step.
  double SquareAndTurn() {
    double cosines = 0, sines = 0;
    for (std::size_t i = 0; i < cosine.size(); ++i) {
      const double c = cosine[i], s = sine[i];
      cosines += c;
      sines += s;
      cosine[i] = c * turn_cosine[i] - s * turn_sine[i];
      sine[i] = c * turn_sine[i] + s * turn_cosine[i];
    }
    return cosines * cosines + sines * sines;
  }
};

/// Which of the first `count` multiples of kCyclesApart over the log, from kFirstCycles on, explains most of what is left if it
/// covers it evenly.
double StrongestCycles(const Bins& bins, const GrowingFit& fit, Index count) {
  // forwards and backwards: as a force in one direction and as one against the motion it is sum and difference of
  // both, whose squares add up to twice those of both
  const VectorXd left = bins.weight.cwiseProduct(fit.Left());
  const ArrayXd step = 2 * kPi * kCyclesApart * bins.time.array();
  const MatrixXd turns = Waves(step);
  const MatrixXd first = left.asDiagonal() * Waves(kFirstCycles * step);
  TurningWaves directions[2];
  for (Index c = 0; c < bins.size(); ++c) {
    TurningWaves& waves = directions[bins.velocity[c] < 0];
    waves.cosine.push_back(first(c, 0));
    waves.sine.push_back(first(c, 1));
    waves.turn_cosine.push_back(turns(c, 0));
    waves.turn_sine.push_back(turns(c, 1));
  }
  Index strongest = 0;
  double most = -1;
  for (Index k = 0; k < count; ++k) {
    const double explained = directions[0].SquareAndTurn() + directions[1].SquareAndTurn();
    if (explained > most) strongest = k;
    most = std::max(most, explained);
  }
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

Features OfEnergy(const Bins& bins, const Circumstances& known, const GrowingFit&) {
  return {Signed(bins, known.energies)};
}

Features OfSpeedByEnergy(const Bins&, const Circumstances& known, const GrowingFit&) {
  return {known.heating.slope};
}

Features OfInitialEnergy(const Bins&, const Circumstances& known, const GrowingFit&) {
  return {known.initial};
}

Features OfLoad(const Bins& bins, const Circumstances& known, const GrowingFit&) {
  return {ConcatColumns(Signed(bins, known.loads), known.loads.leftCols(known.loads.cols() / 2))};
}

Features OfTemperature(const Bins& bins, const Circumstances& known, const GrowingFit&) {
  return {Signed(bins, known.temperatures)};
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

Features OfSpeedMemory(const Bins& bins, const Circumstances& known, const GrowingFit& fit) {
  // without a warming in the fit its heat, which follows the speed late, too, would look like that
  if (known.past.empty() || known.heating.slope.cols() == 0) return {MatrixXd(bins.size(), 0)};
  const MatrixXd& all = known.late_speeds;
  // the time constant that explains most beside the fit
  Index best = 0;
  fit.ExplainedBy(all).maxCoeff(&best);
  return {all.col(best), static_cast<int>(all.cols()), known.past[static_cast<size_t>(best)]};
}

Features OfStep(const Bins& bins, const Circumstances&, const GrowingFit& fit) {
  // how many places each row has passed, by the samples before it
  constexpr Index places = kPlaces - 1;
  std::vector<Index> passed;
  const double total = bins.weight.sum();
  double before = 0;
  for (const double weight : bins.weight) {
    passed.push_back(std::min(static_cast<Index>(before / total * kPlaces), places));
    before += weight;
  }

  // the one step, of the offset or of the friction, that explains most beside the fit
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
  // half a turn with each segment, which changes the sign of its waves
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

Features OfPeriod(const Bins& bins, const Circumstances& known, const GrowingFit& fit) {
  // no more cycles than the bins resolve, or than one a hold
  const double most = std::min(static_cast<double>(bins.size()) / kBinsACycle,
                               known.hold > 0 ? known.duration / known.hold : kInfinity);
  const Index count = static_cast<Index>(most / kCyclesApart) - kFirstCycles + 1;
  if (count < 1) return {MatrixXd(bins.size(), 0)};
  const double cycles = StrongestCycles(bins, fit, count);
  return {BothDirections(bins, Waves(2 * kPi * cycles * bins.time.array())),
          static_cast<int>(count), known.duration / cycles};
}

}  // namespace warmjoint
