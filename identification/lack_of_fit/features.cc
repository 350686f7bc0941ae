#include "identification/lack_of_fit/features.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "identification/lack_of_fit/distinct.h"
#include "identification/lack_of_fit/wave_products.h"
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
MatrixXd BothWays(const Bins& bins, const MatrixXd& columns) {
  MatrixXd both(columns.rows(), 2 * columns.cols());
  both << columns, Signed(bins, columns);
  return both;
}

/// Squares of the products of a rest, of the rows of one direction of motion, with the waves of some cycles over the
/// log. left: [m] weighted, N.m or N; returns [cycles].
VectorXd SquaresOf(const Bins& bins, const VectorXd& left, double sign, const Frequencies& cycles) {
  std::vector<Index> rows;
  for (Index c = 0; c < bins.size(); ++c) {
    if (bins.velocity[c] * sign > 0) rows.push_back(c);
  }
  return WaveProducts(left(rows), bins.time(rows), cycles).rowwise().squaredNorm();
}

/// How many of some cycles over the log explain most of what is left if they cover it evenly.
double StrongestCycles(const Bins& bins, const GrowingFit& fit, const Frequencies& cycles) {
  const VectorXd left = bins.weight.cwiseProduct(fit.Left());
  // as a force in one direction and as one against the motion: sum and difference of the directions, whose squares add
  // up to twice those of both
  const VectorXd explained = SquaresOf(bins, left, 1, cycles) + SquaresOf(bins, left, -1, cycles);
  Index strongest = 0;
  explained.maxCoeff(&strongest);
  return cycles.At(strongest);
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
  return {Beside(Signed(bins, known.loads), known.loads.leftCols(known.loads.cols() / 2))};
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
  // a column for each place, of the rows that have passed it
  SharedColumns after;
  after.shares = MatrixXd::Zero(kPlaces, kPlaces - 1);
  after.shares.triangularView<Eigen::StrictlyLower>().setOnes();
  // the places that a row has passed, by the samples before it
  const double total = bins.weight.sum();
  double before = 0;
  for (Index c = 0; c < bins.size(); ++c) {
    after.place.push_back(
        std::min<Index>(static_cast<Index>(before / total * kPlaces), kPlaces - 1));
    before += bins.weight[c];
  }

  // the one step, of the offset or of the friction, that explains most beside the fit
  SharedColumns turned = after;
  after.factor.setOnes(bins.size());
  turned.factor = SignOf(bins);
  VectorXd explained(2 * after.shares.cols());
  explained << fit.ExplainedBy(after), fit.ExplainedBy(turned);
  Index best = 0;
  explained.maxCoeff(&best);
  const Index offsets = after.shares.cols();
  return {best < offsets ? after.Column(best) : turned.Column(best - offsets),
          static_cast<int>(explained.size())};
}

Features OfHoldParity(const Bins& bins, const Circumstances&, const GrowingFit&) {
  if (bins.hold.size() == 0) return {MatrixXd(bins.size(), 0)};
  // half a turn with each segment, which changes the sign of its waves
  const Distinct phases(bins.phase);
  const MatrixXd waves = Waves(kPi * phases.values());
  MatrixXd parity(bins.size(), 3);
  for (Index i = 0; i < bins.size(); ++i) {
    const double sign = static_cast<Index>(bins.hold[i]) % 2 == 0 ? 1 : -1;
    parity(i, 0) = sign;
    parity.row(i).tail<2>() = sign * waves.row(phases.place[static_cast<size_t>(i)]);
  }
  return {BothWays(bins, parity)};
}

Features OfHoldPhase(const Bins& bins, const Circumstances&, const GrowingFit&) {
  if (bins.hold.size() == 0) return {MatrixXd(bins.size(), 0)};
  const Distinct phases(bins.phase);
  const ArrayXd waves = (2 * kPi * phases.values()).cos();
  MatrixXd phase(bins.size(), 2);
  phase << (bins.phase.array() - 0.5).matrix(), waves(phases.place).matrix();
  return {BothWays(bins, phase)};
}

Features OfPeriod(const Bins& bins, const Circumstances& known, const GrowingFit& fit) {
  // no more cycles than the bins resolve, or than one a hold
  const double most = std::min(static_cast<double>(bins.size()) / kBinsACycle,
                               known.hold > 0 ? known.duration / known.hold : kInfinity);
  const Index count = static_cast<Index>(most / kCyclesApart) - kFirstCycles + 1;
  if (count < 1) return {MatrixXd(bins.size(), 0)};
  const double cycles = StrongestCycles(bins, fit, {kCyclesApart, kFirstCycles, count});
  return {BothWays(bins, Waves(2 * kPi * cycles * bins.time.array())), static_cast<int>(count),
          known.duration / cycles};
}

}  // namespace warmjoint
