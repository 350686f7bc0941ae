// Identifier `kalman`: parameters and energy online, by a bank of extended Kalman filters.
//
// Runs a KalmanBank over the recording, from knowing nothing of law, gain and time constant and
// E(0) = 0: one pass is what a controller would know at the end. The bank's members lie 0.1 to 0.4
// apart in ln tau, near enough to be right to about twice the Cramer-Rao bound. Each further pass
// over the stored recording is linearised where the last one ended, until nothing moves: then the
// answer is that of maximum likelihood.
//
// Standard deviations and 95 % intervals as in uncertainty.h, from the exact Jacobian of the
// closed loop; none after a single pass, which they would not hold for. not_converged where the
// last pass moved a parameter by more than its standard deviation; not_identifiable as energy-ml.
// The trace holds parameters and energy at 50 moments of the last pass.
#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "identification/fit_data.h"
#include "identification/fit_parameters.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/inference/inference.h"
#include "identification/linear/least_squares.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/rigid_part.h"
#include "identification/online/kalman_passes.h"
#include "identification/warming/warming_verdict.h"

namespace warmjoint {
namespace {

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

/// One pass is not efficient, and what still moves has not arrived.
void JudgePasses(const std::vector<KalmanPass>& passes, Fit& fit) {
  const Uncertainty& known = *fit.errors.known;
  if (passes.size() == 1) {
    fit.summary += NoiseOf(known);
    fit.without_intervals = "intervals need more than one pass";
    return;
  }

  // the last pass against the one before, by the standard errors
  const Eigen::Index p = known.covariance.rows();
  const Eigen::VectorXd moved = passes.back().mean - passes[passes.size() - 2].mean;
  const Eigen::ArrayXd deviation = known.covariance.diagonal().cwiseSqrt();
  if ((moved.head(p).cwiseAbs().array() <= deviation).all()) return;
  fit.voided = {Status::not_converged,
                "the last pass still moved parameters by more than their standard deviation; give "
                "more passes, or try --identifier energy-ml"};
}

/// Law and warming where the last pass ended.
struct Ending {
  Eigen::VectorXd x;  // [d] of the law
  Thermal thermal;
};

Ending EndingOf(const KalmanPass& last) {
  const Eigen::Index d = last.mean.size() - 3;
  return {last.mean.head(d), {last.mean[d], std::exp(last.mean[d + 1])}};
}

Refusal RanAway() { return {Status::not_converged, "the filters ran away", FrictionKind::warm_up}; }

/// Why the recording does not tell these parameters; nothing where it does. joint: the Jacobian's.
std::optional<Refusal> WhyRefused(const KalmanTrack& track, const Fit& fit, const Ending& ending,
                                  const LeastSquares& joint, const LoopResponse& response,
                                  double nominal_squares) {
  const Measurements& m = track.measurements;
  const Eigen::Index p = ending.x.size() + 2;

  // how clearly the warming is seen, and how well its time constant is known
  const double squares = fit.residual().squaredNorm();
  const double variance = squares / static_cast<double>(fit.torque.size() - p);
  const auto [shortest, longest] = TimeConstantRange(track);
  const double vague =
      joint.rank == p ? std::sqrt(variance * joint.cofactor(p - 1, p - 1)) : kInfinity;
  if (auto why = UnidentifiableWarming(
          {ExplainedVariances(nominal_squares, squares, static_cast<double>(fit.torque.size() - p),
                              fit.torque),
           vague, ending.thermal.time_constant, shortest, longest,
           m.time[m.size() - 1] - m.time[0]})) {
    return Refusal{Status::not_identifiable, *why};
  }
  if (response.feeds_itself) {
    return Refusal{Status::inadequate_model,
                   WouldFeedItself(m.time[*response.feeds_itself],
                                   RemedyForNonDissipative("energy-ml", "", FittedGravity::none))};
  }
  return std::nullopt;
}

/// The fit that the last pass makes, with its verdict. nominal_squares: of the fit without warming.
Fit Conclude(const KalmanTrack& track, const std::vector<KalmanPass>& passes,
             double nominal_squares) {
  const Measurements& m = track.measurements;
  const KalmanPass& last = passes.back();
  const Ending ending = EndingOf(last);
  const auto& [x, thermal] = ending;
  Fit fit;
  fit.identifier = kName;
  fit.parameters = LawParameters(track.law, x, m);
  Append(HeatParameters(thermal, m), fit);
  if (!last.mean.allFinite() || !(thermal.time_constant > 0) ||
      !std::isfinite(thermal.time_constant)) {
    fit.refusal = RanAway();
    return fit;
  }

  // the model, and how well it fits
  fit.friction = FrictionOf(track.law, x, m);
  fit.friction.thermal = thermal;
  const LoopResponse response = track.loop.Simulate(x, thermal);
  fit.used = track.selection;
  fit.torque = Kept(m.torque, fit.used);
  fit.fitted = Kept(response.force, fit.used);
  fit.count = static_cast<int>(x.size()) + 2;
  fit.effective_parameters = fit.count;

  // what the whole recording knows of these parameters
  Eigen::MatrixXd jacobian = Kept(track.loop.Jacobian(x, thermal), fit.used).leftCols(fit.count);
  jacobian.col(fit.count - 1) *= thermal.time_constant;  // by ln tau
  if (!fit.fitted.allFinite() || !jacobian.allFinite()) {
    fit.refusal = RanAway();
    return fit;
  }
  const LeastSquares joint = SolveLeastSquares(jacobian, fit.torque, kSingular);
  fit.refusal = WhyRefused(track, fit, ending, joint, response, nominal_squares);
  if (fit.refusal) return fit;
  fit.errors.known =
      EstimateCovariance(jacobian, joint.cofactor, fit.residual(), fit.used, fit.fitted);
  fit.summary = fmt::format("filtered in {} passes over {} samples; at the end E is {:.4g} {}",
                            passes.size(), fit.torque.size(), last.mean.tail(1)[0], m.torque_unit);

  // a law that the data rule out needs no verdict on its passes
  if (Infer(fit).status == Status::ok) JudgePasses(passes, fit);
  return fit;
}

Fit FitOnline(const IdentifierInput& input) {
  const Measurements& m = input.measurements;
  const Law& law = *input.options.Get<LawOption>().law;
  const auto d = static_cast<int>(law.parameters.size());
  if (!m.starts.empty()) {
    return Refused(
        kName, Status::bad_data,
        "kalman follows one recording; give one, or try --identifier energy-ml for several");
  }
  if (auto why = Unusable(input, d + 2)) return Refused(kName, Status::bad_data, *why);

  // the law's columns must be distinct before any warming is thought of
  const Eigen::MatrixXd columns = LawColumns(law, m.velocity);
  const Eigen::VectorXd torque = Kept(m.torque, input.selection);
  const Eigen::MatrixXd kept = Kept(columns, input.selection);
  const LeastSquares nominal = SolveLeastSquares(kept, torque);
  if (nominal.rank < d) {
    return Refused(kName, Status::not_identifiable,
                   Indistinct(nominal.mixed, law, m, input.selection));
  }

  // pass after pass over the recording, scaled by the rms of columns and torque
  const double root = std::sqrt(static_cast<double>(torque.size()));
  const KalmanTrack track{law,
                          m,
                          input.selection,
                          ClosedLoop(m.time, m.velocity, columns),
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
