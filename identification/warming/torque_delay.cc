#include "identification/warming/torque_delay.h"

#include <Eigen/Core>
#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <utility>
#include <vector>

#include "identification/fit/fit_along.h"
#include "identification/fit/fit_data.h"
#include "identification/fit/fit_parameters.h"
#include "identification/inference/inference.h"
#include "identification/linear/rigid_part.h"
#include "identification/model/least_squares.h"
#include "identification/preparation/delayed_motion.h"
#include "identification/sentences/late_torque.h"
#include "models/foundation/robust_noise.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kCertain = 4;  // standard errors; why: by chance 1 in 16,000
// why: a delay that is less certain changes an inertia by as much
constexpr double kToldSteps = 0.5;
constexpr double kLongest = 0.15;    // s; why: buses and filters take less, and motions last longer
constexpr double kLongestSteps = 6;  // of the log, where that is more
constexpr double kOfTheLog = 0.1;    // at most
// to each side; why: 6 ms from one to the next, while motions change over ten times that
constexpr int kTried = 24;
constexpr Index kRows = 5000;  // of a search; why: it only has to find the valley
constexpr int kBits = 12;      // of its refinement, since steps over all samples follow
constexpr int kMostRounds = 8;
constexpr double kArrived = 0.02;  // of the standard error
// s, over which the model is differentiated; why: noise of an acceleration, over one step of the log, would count as motion
// and the delay as better known than it is; the derivative of a motion as short as half a second loses 2 %
constexpr double kDifference = 0.06;

LogView ViewOf(const IdentifierInput& given) { return {given.measurements, given.selection}; }

double LongestDelay(const LogSamples& m, double step) {
  const double duration = m.time[m.size() - 1] - m.time[0];
  return std::min(std::max(kLongest, kLongestSteps * step), kOfTheLog * duration);
}

/// A selection with only some of the samples that take part.
Selection Thinned(Selection selection) {
  const Index each = 1 + selection.count() / kRows;
  for (Index i = 0, seen = 0; i < selection.keep.size(); ++i) {
    if (selection.keep[i] && seen++ % each != 0) selection.keep[i] = false;
  }
  return selection;
}

/// The mean square that law, gravity and inertia leave at a delay; infinite where they cannot be determined.
double MeanSquareAt(double delay, const IdentifierInput& given) {
  LogView late = Delayed(ViewOf(given), delay);
  late.selection = Thinned(std::move(late.selection));
  const IdentifierInput input = given.On(late);
  LinearTask task = BeginLinear(input, 0);
  if (task.refusal) return kInfinity;
  const IdentifierInput chosen = task.gravity.Of(input);
  const LeastSquares solved = SolveLinear(chosen, task);
  if (task.refusal) return kInfinity;
  const VectorXd left = Kept(chosen.measurements.torque, chosen.selection) -
                        Kept(task.columns, chosen.selection) * solved.solution;
  return left.squaredNorm() / static_cast<double>(left.size());
}

/// The delay of the least mean square, between the ends of those that are tried; nothing where it lies at one.
std::optional<double> SearchDelay(const IdentifierInput& given, double longest) {
  const auto at = [&](int k) { return longest * k / kTried; };
  int best = 0;
  double least = MeanSquareAt(0, given);
  for (int k = -kTried; k <= kTried; ++k) {
    const double left = k == 0 ? least : MeanSquareAt(at(k), given);
    if (left < least) std::tie(best, least) = std::pair(k, left);
  }
  if (!std::isfinite(least) || std::abs(best) == kTried) return std::nullopt;
  const auto refined = boost::math::tools::brent_find_minima(
      [&](double delay) { return MeanSquareAt(delay, given); }, at(best - 1), at(best + 1), kBits);
  return refined.first;
}

/// Whether all samples of a span of time around each sample take part: none of them is a turn, a rest or a corner of the velocity,
/// where the torque jumps. from, to: samples before and after it
SampleMask WithoutJumps(const SampleMask& keep, Index from, Index to) {
  const Index n = keep.size();
  std::vector<Index> left_out(static_cast<size_t>(n) + 1, 0);
  for (Index i = 0; i < n; ++i) left_out[i + 1] = left_out[i] + (keep[i] ? 0 : 1);
  SampleMask without = SampleMask::Constant(n, false);
  for (Index i = from; i + to < n; ++i) without[i] = left_out[i + to + 1] == left_out[i - from];
  return without;
}

/// d tau / d delay of a fit, over kDifference around each sample where there is no jump within, else to one of its sides, else
/// over a step of the log. given: as it was logged. [N] N.m/s or N/s
VectorXd ByDelay(const Fit& fit, const IdentifierInput& given, double delay, double step) {
  const auto at = [&](double more) -> VectorXd {
    return TorqueAlong(fit, Delayed(given.measurements, delay + more));
  };
  VectorXd by_delay = (at(step / 2) - at(-step / 2)) / step;
  if (step >= kDifference) return by_delay;

  // a later delay shows motion of before; what counts is sample i - delay / step
  const double width = std::ceil(kDifference / step);
  const auto shift = static_cast<Index>(std::floor(delay / step));
  const auto take = [&](double later, double earlier, const VectorXd& difference) {
    const Index before = std::lround(width * later) + std::max<Index>(shift + 1, 0);
    const Index behind = std::lround(width * earlier) + std::max<Index>(-shift, 0);
    const SampleMask fits = WithoutJumps(given.selection.keep, before, behind);
    by_delay = fits.select(difference / kDifference, by_delay);
  };
  const VectorXd now = at(0);
  take(1, 0, at(kDifference) - now);
  take(0, 1, now - at(-kDifference));
  take(0.5, 0.5, at(kDifference / 2) - at(-kDifference / 2));
  return by_delay;
}

/// What a lag of first order has in addition to a delay of the same size: d^2/2 d^2 tau/dt^2, since 1/(1 + s d) = exp(-s d) +
/// s^2 d^2/2 - ...; 0 where the torque jumps nearby. given: as it was logged. [N] N.m or N
VectorXd ByShape(const Fit& fit, const IdentifierInput& given, double delay, double step) {
  const double width = std::max(step, kDifference / 2);
  const auto at = [&](double more) -> VectorXd {
    return TorqueAlong(fit, Delayed(given.measurements, delay + more));
  };
  const VectorXd bend = (at(width) - 2 * at(0) + at(-width)) / (width * width);
  const auto reach = static_cast<Index>(std::ceil(width / step));
  const auto shift = static_cast<Index>(std::floor(delay / step));
  const SampleMask fits = WithoutJumps(given.selection.keep, reach + std::max<Index>(shift + 1, 0),
                                       reach + std::max<Index>(-shift, 0));
  return fits.select(0.5 * delay * delay * bend, VectorXd::Zero(bend.size()));
}

/// The rows of a fit, followed by the column of the delay, as the fit solved them. [n x p + 1]
MatrixXd RowsOf(const Fit& fit, const VectorXd& by_delay) {
  MatrixXd rows =
      ConcatColumns(Kept(fit.rows.jacobian(), fit.rows.used), Kept(by_delay, fit.rows.used));
  return fit.rows.errors.whitening ? fit.rows.errors.whitening->Of(rows) : rows;
}

/// The delay as one more unknown of a fit that was made at it.
void AddDelay(double delay, const VectorXd& by_delay, const LogSamples& m, Fit& fit) {
  fit.model.delay = delay;
  Append({WithValue(DelayUnknown(UnitsOf(m)), delay)}, fit);
  fit.rows.jacobian = [of_model = std::move(fit.rows.jacobian), by_delay] {
    return ConcatColumns(of_model(), by_delay);
  };
  fit.rows.errors.AddFree();
  fit.rows.errors.cofactor = CofactorOf(fit);
  ++fit.rows.count;
  fit.rows.effective_parameters += 1;
}

/// Whether a fit with a delay leaves less of the samples that both used than another: by more than so many variances of the noise,
/// as coloured as it is.
bool Improves(const Fit& late, const Fit& other, double variances) {
  if (other.refusal) return true;
  const VectorXd both = (late.rows.used.keep && other.rows.used.keep).cast<double>();
  const double with =
      AmongAll(late.rows.residual(), late.rows.used, 0).cwiseProduct(both).squaredNorm();
  const double without =
      AmongAll(other.rows.residual(), other.rows.used, 0).cwiseProduct(both).squaredNorm();
  const double variance = with / std::max(both.sum(), 1.0);
  const double inflation = CovarianceOf(late).noise.variance_inflation;
  return without - with > variances * variance * inflation;
}

/// What a delay would change of a fit without one, where the log does not determine whether there is a delay.
Cause UntoldDelay(const Fit& late, const Fit& in_time, double step) {
  Cause cause{.source = Source::late_torque,
              .action = Action::widen,
              .sentence = ExplainUntoldDelay(*late.model.delay, step)};
  for (size_t i = 0; i < in_time.parameters.size(); ++i) {
    const Unknown& row = in_time.parameters[i];
    const auto other = std::ranges::find(late.parameters, row.name, &Unknown::name);
    if (!row.estimated || row.name.empty() || other == late.parameters.end()) continue;
    cause.Add(i, other->value - row.value);
  }
  return cause;
}

/// By how much a fit with a delay is biased where a filter makes the torque late, of first order at most: the log does not
/// determine the shape. rows: RowsOf the fit; shape: [N] ByShape
Cause UntoldShape(const Fit& fit, const MatrixXd& rows, const VectorXd& shape) {
  VectorXd force = Kept(shape, fit.rows.used);
  if (fit.rows.errors.whitening) force = fit.rows.errors.whitening->Of(force);
  const VectorXd bias = SolveLeastSquares(rows, force).solution;
  Cause cause{.source = Source::late_torque, .action = Action::widen};
  Index column = 0;
  for (size_t i = 0; i < fit.parameters.size() && bias.size() > 0; ++i) {
    const Unknown& row = fit.parameters[i];
    if (row.estimated) cause.Add(i, row.ValueByCoordinate(row.value) * bias[column++]);
  }
  return cause;
}

}  // namespace

bool IsLate(const Fit& fit) {
  if (!fit.RowOf(Role::delay)) return false;
  // the last of the estimated rows
  const Uncertainty uncertainty = CovarianceOf(fit);
  return std::abs(*fit.model.delay) >
         kCertain * uncertainty.Deviation(uncertainty.covariance.rows() - 1);
}

bool MayBeLate(const IdentifierInput& given) {
  const auto* option = given.options.Find<DelayOption>();
  return given.measurements.acceleration && option && option->torque_delay == PartFit::estimated;
}

Fit FitBehindDelay(const IdentifierInput& given, const FitInTime& fit_in_time) {
  const LogSamples& m = given.measurements;
  const double step = MedianStep(m.time), longest = LongestDelay(m, step);
  std::optional<double> delay = SearchDelay(given, longest);
  for (int round = 0; delay && round < kMostRounds; ++round) {
    const LogView late = Delayed(ViewOf(given), *delay);
    Fit fit = fit_in_time(given.On(late));
    if (fit.refusal) break;

    // the Gauss-Newton step of all unknowns and of the delay
    const VectorXd by_delay = ByDelay(fit, given, *delay, step);
    const MatrixXd rows = RowsOf(fit, by_delay);
    VectorXd left = fit.rows.residual();
    if (fit.rows.errors.whitening) left = fit.rows.errors.whitening->Of(left);
    const LeastSquares change = SolveLeastSquares(rows, left);
    // the motion does not distinguish it from the other unknowns
    if (change.solution.size() == 0) break;
    const double further = change.solution[rows.cols() - 1];
    AddDelay(*delay, by_delay, m, fit);
    const double deviation = CovarianceOf(fit).Deviation(rows.cols() - 1);
    if (!(std::abs(further) <= std::max(kArrived * deviation, 1e-6 * step))) {
      delay = *delay + further;
      if (!(std::abs(*delay) < longest)) delay.reset();
      if (round + 1 < kMostRounds) continue;
    }
    if (!delay || !(deviation < std::max(kToldSteps * step, std::abs(*delay) / kCertain))) break;
    if (IsLate(fit)) {
      // a fit without a delay must be worse. So must one with a delay of the same size and opposite sign, whose motion between
      // samples is as smooth: with squares (d - c)^2/deviation^2 the difference of the two is 4 d c/deviation^2, in which c
      // must be beyond chance
      Fit in_time = fit_in_time(given);
      const LogView early = Delayed(ViewOf(given), -*delay);
      const double other_side = 4 * kCertain * std::abs(*delay) / deviation;
      const bool is_told = Improves(fit, in_time, kCertain * kCertain) &&
                           Improves(fit, fit_in_time(given.On(early)), other_side);
      if (!is_told) {
        in_time.causes.push_back(UntoldDelay(fit, in_time, step));
        return in_time;
      }
      fit.causes.push_back(Note(ExplainDelay(*fit.model.delay, step)));
      fit.causes.push_back(UntoldShape(fit, rows, ByShape(fit, given, *delay, step)));
    }
    return fit;
  }
  return fit_in_time(given);
}

void TakeDelay(double delay, const LogSamples& m, Fit& fit) {
  fit.model.delay = delay;
  fit.causes.push_back(Note(ExplainDelay(delay, MedianStep(m.time))));
}

}  // namespace warmjoint
