// Identifier `kalman`: parameters and energy online, by a bank of extended Kalman filters.
//
// Runs a KalmanBank over the recording, from knowing nothing of law, gain and time constant and
// E(0) = 0: one pass is what a controller would know at the end. The bank's members are 0.1 to 0.4
// apart in ln tau, near enough to be right to about twice the Cramer-Rao bound. Each further pass
// over the stored recording is linearised where the last one ended, until no parameter changes: then the
// answer is that of maximum likelihood.
//
// Standard deviations and 95 % intervals as in uncertainty.h, from the exact Jacobian of the
// closed loop; none after a single pass, for which they would not be valid. not_converged where the
// last pass changed a parameter by more than its standard deviation; not_identifiable as energy-ml.
// The trace holds parameters and energy at 50 moments of the last pass.
#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "identification/fit/fit.h"
#include "identification/fit/fit_data.h"
#include "identification/fit/fit_parameters.h"
#include "identification/forward/closed_loop.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/inference/inference.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/rigid_part.h"
#include "identification/model/least_squares.h"
#include "identification/online/kalman_bank.h"
#include "identification/sentences/fit.h"
#include "identification/sentences/friction.h"
#include "identification/warming/thermal_fit.h"
#include "identification/warming/warming_verdict.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

/// The recording as the filters read it, and what is computed from it beforehand.
struct KalmanTrack {
  const Law& law;
  const LogSamples& measurements;
  const Selection& selection;
  ClosedLoop loop;
  Eigen::VectorXd column_rms;  // [d] of the law's columns over the kept samples
  double torque_rms = 0;       // over the kept samples, N.m or N
};

/// The state of the filters after a pass.
struct KalmanPass {
  StatePlaces at;              // of the mean
  Eigen::VectorXd mean;        // [d + 3] p, k, ln tau, E
  Eigen::MatrixXd covariance;  // [d + 3 x d + 3]
  double spacing = 0;          // of the bank, in ln tau
  double noise = 0;            // variance, (N.m)^2 or N^2

  Eigen::VectorXd law() const { return mean.head(at.d); }  // [d]
  Thermal thermal() const { return {mean[at.gain()], std::exp(mean[at.log_time_constant()])}; }
};

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
/// is not affected by the few at which the speed changes. (N.m)^2 or N^2.
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

/// Time constants that a recording can show, s: two steps, or a 500th of it, to 5 times its length.
std::array<double, 2> TimeConstantRange(const KalmanTrack& track) {
  const Eigen::VectorXd& time = track.measurements.time;
  const double total = time[time.size() - 1] - time[0];
  return {std::max(2 * track.loop.intervals().typical, total / 500), 5 * total};
}

/// The prior before any sample, which knows only E = 0: standard deviations of ten times what could explain the whole torque,
/// for the gain of thirty times that of a loop at its limit of stability, k |v| = 1.
template <int D>
KalmanPrior<D> Ignorance(const KalmanTrack& track) {
  const StatePlaces at{track.column_rms.size()};
  Eigen::VectorXd variance = Eigen::VectorXd::Zero(at.size());
  variance.head(at.d) = (10 * track.torque_rms / track.column_rms.array()).square();
  variance[at.gain()] = std::pow(30 / track.loop.speed().maxCoeff(), 2);
  KalmanPrior<D> prior;
  prior.state.mean.setZero(at.size());
  prior.state.covariance = variance.asDiagonal();

  // where the time constant may lie, and how large the noise is at first
  const auto [shortest, longest] = TimeConstantRange(track);
  prior.shortest = shortest;
  prior.longest = longest;
  prior.noise = GuessNoise(track);
  return prior;
}

Iterate Note(const StatePlaces& at, const Eigen::VectorXd& mean, Eigen::Index sample, double rmse) {
  Iterate iterate;
  iterate.iteration = static_cast<int>(sample);
  iterate.values.assign(mean.begin(), mean.begin() + at.energy());
  iterate.values[at.log_time_constant()] = std::exp(mean[at.log_time_constant()]);
  iterate.rmse = rmse;
  iterate.energy = mean[at.energy()];
  return iterate;
}

/// One pass; in `trace`, moments on the way.
template <int D>
KalmanPass Pass(const KalmanTrack& track, const KalmanPrior<D>& prior,
                std::vector<Iterate>& trace) {
  trace.clear();
  KalmanBank<D> bank = MakeBank(prior);
  const StatePlaces at = prior.state.places();
  const Eigen::Index n = track.loop.size();
  for (Eigen::Index i = 0; i < n; ++i) {
    bank = BankStep(bank, At<D>(track, i));
    // some moments on the way
    if ((i + 1) % std::max<Eigen::Index>(n / kMoments, 1) != 0) continue;
    const Eigen::VectorXd mean = Merge(bank).mean;
    if (mean.allFinite()) trace.push_back(Note(at, mean, i + 1, std::sqrt(bank.noise)));
  }
  const KalmanState<D> all = Merge(bank);
  return {at, all.mean, all.covariance, Spacing(prior), bank.noise};
}

/// Whether the later pass changed next to nothing.
bool Settled(const KalmanPass& earlier, const KalmanPass& later) {
  const Eigen::Index p = later.at.energy();  // all but E
  const Eigen::ArrayXd moved = (later.mean - earlier.mean).head(p).cwiseAbs();
  return (moved <= 0.1 * later.covariance.diagonal().head(p).array().sqrt()).all();
}

/// The prior of the pass after `last`: linearised where that one ended, but with standard deviations ten times as large, so
/// that the data which are counted twice narrow the result by only half a percent.
template <int D>
KalmanPrior<D> Again(const KalmanPass& last) {
  const StatePlaces& at = last.at;
  const Eigen::Index log_tau = at.log_time_constant();
  KalmanPrior<D> prior;
  prior.state.mean = last.mean;
  prior.state.mean[at.energy()] = 0;
  prior.state.covariance.setZero(at.size(), at.size());
  // law and gain
  prior.state.covariance.topLeftCorner(log_tau, log_tau) =
      100 * last.covariance.topLeftCorner(log_tau, log_tau);

  // members around the time constant
  const double reach = std::max(4 * std::sqrt(last.covariance(log_tau, log_tau)), last.spacing);
  prior.shortest = std::exp(last.mean[log_tau] - reach);
  prior.longest = std::exp(last.mean[log_tau] + reach);
  prior.noise = last.noise;
  return prior;
}

template <int D>
std::vector<KalmanPass> Run(const KalmanTrack& track, int passes, std::vector<Iterate>& trace) {
  KalmanPrior<D> prior = Ignorance<D>(track);
  std::vector<KalmanPass> made;
  for (int pass = 0; pass < passes; ++pass) {
    made.push_back(Pass(track, prior, trace));
    const KalmanPass& last = made.back();
    // a pass that diverged does not count and is the last
    if (!last.mean.allFinite() || !last.covariance.allFinite()) {
      if (pass > 0) made.pop_back();
      break;
    }
    if (pass > 0 && Settled(made[pass - 1], last)) break;

    prior = Again<D>(last);
  }
  return made;
}

/// Passes until one changes no parameter by more than a tenth of its standard deviation, `most` at
/// most; where each of them ended. trace: p, k, tau and E at 50 moments of the last pass.
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

constexpr const char* kName = "kalman";
constexpr double kSingular = 1e-6;  // of the closed loop's Jacobian

struct KalmanOptions {
  int passes = 10;

  template <class A>
  void Serialize(A* a) {
    a->Field("passes", &passes,
             {.bounds = {.at_least = 1, .at_most = 100},
              .meaning = "most passes over the recording; 1: as online, without intervals"});
  }
};

/// Judges the passes: one pass alone is not efficient, and passes after which a parameter still changes have not converged.
void JudgePasses(const std::vector<KalmanPass>& passes, Fit& fit) {
  const Uncertainty uncertainty = CovarianceOf(fit);
  if (passes.size() == 1) {
    fit.summary += NoiseOf(uncertainty);
    fit.causes.push_back(DropsIntervals(kNoIntervalsOfOnePass));
    return;
  }

  // the last pass against the one before, by the standard errors
  const Eigen::Index p = uncertainty.covariance.rows();
  const Eigen::VectorXd moved = passes.back().mean - passes[passes.size() - 2].mean;
  const Eigen::ArrayXd deviation = uncertainty.covariance.diagonal().cwiseSqrt();
  if ((moved.head(p).cwiseAbs().array() <= deviation).all()) return;
  fit.causes.push_back(Invalidate(Status::not_converged, kPassesStillMove));
}

Refusal RanAway() { return {Status::not_converged, kRanAway, FrictionKind::warm_up}; }

/// Why the recording does not determine these parameters; nothing where it does. joint: the Jacobian's.
std::optional<Refusal> WhyRefused(const KalmanTrack& track, const Fit& fit, const KalmanPass& last,
                                  const LeastSquares& joint, const LoopResponse& response,
                                  double nominal_squares) {
  const LogSamples& m = track.measurements;
  const Eigen::Index p = last.at.energy(), log_tau = last.at.log_time_constant();

  // how clearly the warming is seen, and how well its time constant is known
  const double squares = fit.rows.residual().squaredNorm();
  const double variance = squares / static_cast<double>(fit.rows.torque.size() - p);
  const auto [shortest, longest] = TimeConstantRange(track);
  const double vague =
      joint.rank == p ? std::sqrt(variance * joint.cofactor(log_tau, log_tau)) : kInfinity;
  if (auto why = UnidentifiableWarming(
          {ExplainedVariances(nominal_squares, squares,
                              static_cast<double>(fit.rows.torque.size() - p), fit.rows.torque),
           vague, last.thermal().time_constant, shortest, longest, m.time[m.size() - 1] - m.time[0],
           MedianStep(m.time)})) {
    return Refusal{Status::not_identifiable, *why};
  }
  if (response.first_driving) {
    return Refusal{Status::inadequate_model,
                   ExplainDriving(m.time[*response.first_driving], RemedyForNonDissipative(""))};
  }
  return std::nullopt;
}

/// The fit that the last pass makes, with its verdict. nominal_squares: of the fit without warming.
Fit Conclude(const KalmanTrack& track, const std::vector<KalmanPass>& passes,
             double nominal_squares) {
  const LogSamples& m = track.measurements;
  const KalmanPass& last = passes.back();
  const Eigen::VectorXd x = last.law();
  const Thermal thermal = last.thermal();
  Fit fit;
  fit.identifier = kName;
  fit.parameters = WithValues(LawUnknowns(track.law, x.size(), UnitsOf(m)), x);
  Append(HeatParameters(thermal, m), fit);
  if (!last.mean.allFinite() || !(thermal.time_constant > 0) ||
      !std::isfinite(thermal.time_constant)) {
    fit.refusal = RanAway();
    return fit;
  }

  // the model, and how well it fits
  fit.model.friction = FrictionOf(track.law, x, m);
  fit.model.friction.thermal = thermal;
  const LoopResponse response = track.loop.Simulate(x, thermal);
  fit.rows.used = track.selection;
  fit.rows.torque = Kept(m.torque, fit.rows.used);
  fit.rows.fitted = Kept(response.force, fit.rows.used);
  fit.rows.count = static_cast<int>(last.at.energy());
  fit.rows.effective_parameters = fit.rows.count;

  // the information of the whole recording on these parameters
  const LawBlocks law(track.loop, LawColumns(track.law, m.velocity));
  Eigen::MatrixXd jacobian =
      Kept(WarmJacobian(law, x, thermal, 0), fit.rows.used).leftCols(fit.rows.count);
  jacobian.col(last.at.log_time_constant()) *= thermal.time_constant;  // from tau to ln tau
  if (!fit.rows.fitted.allFinite() || !jacobian.allFinite()) {
    fit.refusal = RanAway();
    return fit;
  }
  const LeastSquares joint = SolveLeastSquares(jacobian, fit.rows.torque, kSingular);
  fit.refusal = WhyRefused(track, fit, last, joint, response, nominal_squares);
  if (fit.refusal) return fit;
  const Uncertainty uncertainty = CovarianceOf({.rows = RowsFrom([&] { return jacobian; }),
                                                .cofactor = joint.cofactor,
                                                .residual = fit.rows.residual(),
                                                .selection = fit.rows.used,
                                                .fitted = fit.rows.fitted});
  fit.rows.errors.covariance = [uncertainty] { return uncertainty; };
  fit.summary = SummaryOfFilter(passes.size(), fit.rows.torque.size(), last.mean[last.at.energy()],
                                m.torque_unit);

  // a law that the data rule out needs no verdict on its passes
  if (Infer(fit).status == Status::ok) JudgePasses(passes, fit);
  return fit;
}

Fit FitOnline(const IdentifierInput& input) {
  const LogSamples& m = input.measurements;
  if (!m.further_starts.empty()) {
    return Refused(kName, Status::bad_data, kFollowsOneRecording);
  }
  // the law's columns must be distinct before a warming is fitted
  LinearTask task = BeginLinear(input, 2);
  const LeastSquares nominal = SolveLinear(input, task);
  if (task.refusal) return Refused(kName, *task.refusal);

  // pass after pass over the recording, scaled by the rms of columns and torque
  const Eigen::VectorXd torque = Kept(m.torque, input.selection);
  const Eigen::MatrixXd kept = Kept(task.columns, input.selection);
  const double root = std::sqrt(static_cast<double>(torque.size()));
  const KalmanTrack track{task.law,
                          m,
                          input.selection,
                          ClosedLoop(m.time, m.velocity, task.columns),
                          kept.colwise().norm().transpose() / root,
                          torque.norm() / root};
  std::vector<Iterate> trace;
  const std::vector<KalmanPass> passes =
      RunPasses(track, input.options.Get<KalmanOptions>().passes, trace);
  Fit fit = Conclude(track, passes, (torque - kept * nominal.solution).squaredNorm());
  fit.trace = std::move(trace);
  return fit;
}

}  // namespace

Identifier Kalman() {
  return {kName, "law, warming and energy online, by a bank of extended Kalman filters",
          OptionGroups<LawOption, KalmanOptions>{}, &FitOnline};
}

}  // namespace warmjoint
