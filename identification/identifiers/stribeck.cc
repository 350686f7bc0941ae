#include "identification/identifiers/stribeck.h"

#include <fmt/format.h>

#include <cmath>

#include "identification/describe_friction.h"
#include "identification/fit_data.h"
#include "identification/forward/predict.h"
#include "identification/linear/least_squares.h"
#include "identification/linear/linear_laws.h"
#include "identification/nonlinear/stribeck_fit.h"
#include "identification/nonlinear/stribeck_verdict.h"
#include "identification/uncertainty/student.h"
#include "identification/uncertainty/uncertainty.h"
#include "identification/warming/report_thermal.h"
#include "identification/warming/scan_time_constant.h"
#include "identification/warming/unsettled.h"
#include "identification/warming/warm_fit.h"
#include "identification/warming/warming_verdict.h"
#include "models/friction/stribeck.h"
#include "models/friction/viscous_coulomb.h"

namespace warmjoint::inline identification {
namespace {

constexpr const char* kName = "stribeck";
constexpr size_t kRefined = 3;                              // starts
constexpr Eigen::Index kStatic = 2, kLogVs = 3, kGain = 4;  // in x

/// What the law without the Stribeck effect leaves, with the same warming. (N.m)^2 or N^2
double SquaresWithout(const StribeckProblem& problem) {
  const Measurements& m = problem.measurements;
  const Law& law = *FindLaw(ViscousCoulomb::name);
  const Eigen::MatrixXd columns = LawColumns(law, m.velocity);
  const Eigen::VectorXd torque = Kept(m.torque, problem.selection);
  const Eigen::MatrixXd kept = Kept(columns, problem.selection);
  const LeastSquares cold = SolveLeastSquares(kept, torque);
  const double squares = (torque - kept * cold.solution).squaredNorm();
  if (problem.warming == Warming::none) return squares;

  const ClosedLoop loop(m.time, m.velocity, columns, m.starts);
  const Eigen::VectorXd level = loop.direction().cwiseProduct(m.torque);
  const Eigen::VectorXd weight = problem.selection.keep.cast<double>();
  const WarmStart start = ScanTimeConstant(loop, level, weight);
  const double scale = std::sqrt(squares / static_cast<double>(torque.size()));
  const WarmFit fit = FitWarmFriction(loop, level, Eigen::MatrixXd(m.size(), 0), weight, start,
                                      InitialEnergy::zero, scale);
  return std::min(squares, fit.solution.squares);
}

/// The drop of |e|^2 / s^2 that static and stribeck_velocity bring.
double Explained(const IdentifierInput& input, double without, const StribeckPoint& point) {
  const auto freedom = static_cast<double>(input.selection.count() - point.x.size());
  return (without - point.squares) / (point.squares / freedom);
}

/// Why they cannot be seen: one sentence.
std::string Unseen(const IdentifierInput& input, double explained) {
  return fmt::format(
      "no Stribeck effect can be seen: static and stribeck_velocity explain {:.3g} times the noise "
      "variance, below {:.3g}; {}",
      explained > 0 ? explained : 0.0, kVisibleWarming,
      SlowSpeeds(input.measurements, input.selection));
}

/// What the fit says of the two parameters of the effect.
StribeckEvidence EvidenceOf(const StribeckFit& fit, const Uncertainty& known) {
  const Eigen::VectorXd& x = fit.solution.x;
  const Eigen::Matrix2d c = known.covariance.block<2, 2>(1, 1);
  return {x[2] - x[1], std::sqrt(c(0, 0) + c(1, 1) - 2 * c(0, 1)), known.Deviation(kLogVs)};
}

/// Why the warming cannot be told; nothing where it can, or is not asked for.
std::optional<std::string> VagueWarming(const StribeckProblem& problem, const StribeckFit& fit,
                                        const Uncertainty& known, double cold_squares) {
  if (problem.warming == Warming::none) return std::nullopt;
  const Eigen::VectorXd& time = problem.measurements.time;
  const double total = time[time.size() - 1] - time[0];
  const Eigen::Index n = fit.fitted.size();
  const double variance = fit.solution.squares / static_cast<double>(n - fit.solution.x.size());
  return UnknownWarming({(cold_squares - fit.solution.squares) / variance,
                         known.Deviation(kGain + 1), std::exp(fit.solution.x[kGain + 1]),
                         2 * problem.intervals.typical, 5 * total});
}

/// Puts values, deviations and intervals into the estimate.
void Report(const StribeckProblem& problem, const StribeckFit& fit, const Uncertainty& known,
            Estimate& estimate) {
  const Measurements& m = problem.measurements;
  const Eigen::VectorXd& x = fit.solution.x;
  const auto& table = Stribeck::parameters;
  for (Eigen::Index i = 0; i <= kStatic; ++i) {
    estimate.parameters.push_back(WithInterval(
        std::string(table[i].name), x[i], UnitFor(table[i], m), known.Deviation(i), known.freedom));
  }

  // vs is positive and its logarithm the nearer to normal
  const double vs = std::exp(x[kLogVs]);
  const double factor = std::exp(StudentQuantile(known.freedom) * known.Deviation(kLogVs));
  estimate.parameters.push_back({std::string(table[3].name),
                                 vs,
                                 UnitFor(table[3], m),
                                 vs * known.Deviation(kLogVs),
                                 {{vs / factor, vs * factor}}});
  estimate.parameters.push_back(
      {std::string(table[4].name), problem.exponent, UnitFor(table[4], m), {}, {}});
  if (problem.warming == Warming::none) return;
  ReportThermal({x[kGain], std::exp(x[kGain + 1])}, known.covariance.block<2, 2>(kGain, kGain),
                known.freedom, m, estimate);
}

/// The friction of a fit, or why there is none.
void Describe(const IdentifierInput& input, const StribeckProblem& problem, const StribeckFit& fit,
              Estimate& estimate) {
  const Eigen::VectorXd& x = fit.solution.x;
  DescribeFriction(*FindLaw(Stribeck::name), input.measurements, estimate);
  if (!estimate.friction || problem.warming == Warming::none) return;
  estimate.friction->thermal = Thermal{x[kGain], std::exp(x[kGain + 1])};
  const Prediction predicted = PredictFriction(*estimate.friction, input.measurements);
  if (predicted.feeds_itself == input.measurements.size()) return;
  Void(Status::inadequate_model,
       WouldFeedItself(input.measurements.time[predicted.feeds_itself], "try another law"),
       estimate);
}

std::vector<TraceEntry> Trace(const std::vector<StribeckPoint>& scan, Eigen::Index n) {
  std::vector<TraceEntry> trace;
  for (const StribeckPoint& point : scan) {
    TraceEntry entry;
    entry.iteration = static_cast<int>(trace.size());
    for (int i = 0; i <= kStatic; ++i) {
      entry.parameters.emplace_back(Stribeck::parameters[i].name, point.x[i]);
    }
    entry.parameters.emplace_back(Stribeck::parameters[3].name, std::exp(point.x[kLogVs]));
    entry.rmse = std::sqrt(point.squares / static_cast<double>(n));
    trace.push_back(std::move(entry));
  }
  return trace;
}

/// The best of the refined starts.
StribeckFit FitFrom(const StribeckProblem& problem, const std::vector<StribeckPoint>& scan) {
  StribeckFit best = RefineStribeck(problem, scan[0]);
  for (size_t i = 1; i < std::min(kRefined, scan.size()); ++i) {
    StribeckFit fit = RefineStribeck(problem, scan[i]);
    if (fit.converged && (!best.converged || fit.solution.squares < best.solution.squares)) {
      best = std::move(fit);
    }
  }
  return best;
}

/// What the law leaves without warming; 0 where no warming is asked for. (N.m)^2 or N^2
double ColdSquares(const StribeckProblem& problem) {
  if (problem.warming == Warming::none) return 0;
  StribeckProblem cold = problem;
  cold.warming = Warming::none;
  const std::vector<StribeckPoint> scan = ScanStribeckVelocity(cold);
  return scan.empty() ? kInfinity : RefineStribeck(cold, scan[0]).solution.squares;
}

/// The verdict on a fit, and its numbers where they can be trusted.
Estimate Conclude(const IdentifierInput& input, const StribeckProblem& problem,
                  const StribeckFit& fit, double without, double cold_squares) {
  if (!fit.converged) {
    return Failed(kName, Status::not_converged,
                  "the fit still moves after 100 iterations; " +
                      WhyUnsettled(input.measurements, "law stribeck"));
  }
  const double explained = Explained(input, without, fit.solution);
  if (!(explained > kVisibleWarming)) {
    return Failed(kName, Status::not_identifiable, Unseen(input, explained));
  }
  const Eigen::VectorXd torque = Kept(input.measurements.torque, input.selection);
  const Uncertainty known =
      JudgeUncertainty(fit.jacobian, Cofactor(fit.jacobian.transpose() * fit.jacobian),
                       torque - fit.fitted, input.selection, fit.fitted);
  if (auto why = VagueStribeck(EvidenceOf(fit, known), input.measurements, input.selection)) {
    return Failed(kName, Status::not_identifiable, *why);
  }
  if (auto why = VagueWarming(problem, fit, known, cold_squares)) {
    return Failed(kName, Status::not_identifiable, *why);
  }

  Estimate estimate;
  estimate.identifier = kName;
  const auto p = static_cast<int>(fit.solution.x.size());
  estimate.metrics = ComputeMetrics(torque, fit.fitted, p, p);
  Report(problem, fit, known, estimate);
  estimate.message = fmt::format("least squares on {} samples, exponent {:.3g} given{}",
                                 torque.size(), problem.exponent, NoiseOf(known));
  Describe(input, problem, fit, estimate);
  return estimate;
}

Estimate Identify(const IdentifierInput& input) {
  const Measurements& m = input.measurements;
  if (auto why = Unusable(input, 7)) return Failed(kName, Status::bad_data, *why);

  // the columns of Eq. (2) must be distinct before any Stribeck effect is thought of
  const Eigen::VectorXd torque = Kept(m.torque, input.selection);
  const Law& sliding = *FindLaw(ViscousCoulomb::name);
  const LeastSquares nominal =
      SolveLeastSquares(Kept(LawColumns(sliding, m.velocity), input.selection), torque);
  if (nominal.rank < 2) {
    return Failed(
        kName, Status::not_identifiable,
        Indistinct({"viscous", "coulomb", "static", "stribeck_velocity"}, m, input.selection));
  }

  StribeckProblem problem{
      m,
      input.selection,
      FindIntervals(m.time, m.starts),
      input.options.Number("exponent"),
      input.options.Text("warming") == "estimated" ? Warming::estimated : Warming::none,
      torque.norm() / std::sqrt(static_cast<double>(torque.size()))};
  const double without = SquaresWithout(problem);
  const std::vector<StribeckPoint> scan = ScanStribeckVelocity(problem);
  if (scan.empty() || !std::isfinite(without)) {
    return Failed(kName, Status::not_identifiable,
                  "static and stribeck_velocity cannot be told from coulomb; " +
                      SlowSpeeds(input.measurements, input.selection));
  }

  // where the scan, within a few per cent of the best, sees next to nothing, so will the fit
  const double seen = Explained(input, without, scan[0]);
  Estimate estimate =
      problem.warming == Warming::none && seen < 0.5 * kVisibleWarming
          ? Failed(kName, Status::not_identifiable, Unseen(input, seen))
          : Conclude(input, problem, FitFrom(problem, scan), without, ColdSquares(problem));
  estimate.trace = Trace(scan, torque.size());
  return estimate;
}

}  // namespace

Identifier StribeckByCeres() {
  return {kName,
          "the Stribeck law by least squares, with or without warming; needs no start",
          {{"warming", "none", "none|estimated", "whether friction warms up"},
           {"exponent", "2", "number >= 0.1 <= 10", "the law's stribeck_exponent, fixed"}},
          &Identify};
}

}  // namespace warmjoint::inline identification
