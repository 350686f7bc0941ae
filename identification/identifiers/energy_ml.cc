#include "identification/identifiers/energy_ml.h"

#include <fmt/format.h>

#include <cmath>

#include "identification/describe_friction.h"
#include "identification/fit_data.h"
#include "identification/linear/fit_gravity.h"
#include "identification/linear/least_squares.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/linear_task.h"
#include "identification/linear/report_law.h"
#include "identification/linear/robust.h"
#include "identification/maps/energy_ml_maps.h"
#include "identification/uncertainty/uncertainty.h"
#include "identification/warming/gaps.h"
#include "identification/warming/report_thermal.h"
#include "identification/warming/robust_warm_fit.h"
#include "identification/warming/scan_time_constant.h"
#include "identification/warming/unsettled.h"
#include "identification/warming/warming_verdict.h"

namespace warmjoint::inline identification {
namespace {

constexpr const char* kName = "energy-ml";

/// Why the warm-up cannot be told; nothing where it can. variance: of the noise; cofactor: of x;
/// nominal_squares: of the fit without warming.
std::optional<std::string> UntoldWarming(const WarmFit& fit, const WarmStart& scanned,
                                         double variance, double nominal_squares,
                                         const Eigen::MatrixXd& cofactor) {
  const double explained = (nominal_squares - fit.solution.squares) / variance;
  if (!fit.converged) {
    if (auto why = UnseenWarming(explained)) return why;
    return RunawayWarming(fit.thermal().time_constant, scanned.longest / kScannedBeyond);
  }
  const Eigen::Index i = fit.law_parameters + 1;
  return UnknownWarming({explained, std::sqrt(variance * cofactor(i, i)),
                         fit.thermal().time_constant, scanned.shortest, scanned.longest,
                         scanned.longest / kScannedBeyond});
}

std::vector<TraceEntry> Trace(const WarmFit& fit, const Law& law, double step, Eigen::Index n) {
  std::vector<TraceEntry> trace;
  for (const WarmIterate& iterate : fit.trace) {
    TraceEntry entry;
    entry.iteration = static_cast<int>(trace.size());
    entry.rmse = std::sqrt(iterate.squares / static_cast<double>(n));
    const Eigen::Index d = fit.law_parameters;
    for (Eigen::Index i = 0; i < d; ++i) {
      entry.parameters.emplace_back(law.parameters[i].name, iterate.x[i]);
    }
    const Thermal thermal{iterate.x[d], std::exp(iterate.x[d + 1])};
    const DiscreteThermal discrete = Discretise(thermal, step);
    entry.parameters.emplace_back("thermal_gain", thermal.gain);
    entry.parameters.emplace_back("thermal_time_constant", thermal.time_constant);
    entry.parameters.emplace_back("thermal_gain_discrete", discrete.gain);
    entry.parameters.emplace_back("thermal_pole", discrete.pole);
    trace.push_back(std::move(entry));
  }
  return trace;
}

/// d(F + G)/dx over all samples, [N x p].
Eigen::MatrixXd Jacobian(const ClosedLoop& loop, const GravityFit& gravity, const WarmFit& fit) {
  const Thermal thermal = fit.thermal();
  const Eigen::MatrixXd all =
      loop.Jacobian(fit.parameters(), thermal, fit.initial_energy(), fit.jump_values());
  const Eigen::Index first = fit.law_parameters + (fit.estimates_initial_energy() ? 3 : 2);
  Eigen::MatrixXd jacobian = all.leftCols(first);
  jacobian.col(fit.law_parameters + 1) *= thermal.time_constant;  // from tau to log(tau)
  jacobian = Beside(jacobian, all.rightCols(fit.jump_weights.size()));
  return Beside(jacobian, gravity.columns);
}

/// What a fit is made of, and the fit.
struct Task {
  const IdentifierInput& input;
  const Law& law;
  const GravityFit& gravity;
  const ClosedLoop& loop;
  const WarmStart& scanned;
  const std::vector<LogGap>& gaps;
};

/// How sure a fit is, whatever its loss. residual, fitted: [n]
Uncertainty Judge(const Task& task, const RobustWarmFit& robust, const Eigen::VectorXd& residual,
                  const Eigen::VectorXd& fitted) {
  const Selection& selection = task.input.selection;
  const Eigen::VectorXd prior = robust.fit.prior();
  const auto jacobian = [&] {
    return Kept(Jacobian(task.loop, task.gravity, robust.fit), selection);
  };
  if (std::isinf(robust.threshold)) {
    return JudgeUncertainty(jacobian, Cofactor(robust.fit.normal), residual, selection, fitted,
                            prior);
  }
  const Eigen::MatrixXd rows = jacobian();
  Eigen::MatrixXd normal = rows.transpose() * rows;
  normal.diagonal() += prior;
  return JudgeUncertainty(rows, Cofactor(normal), HuberScores(residual, robust.threshold),
                          selection, fitted, prior);
}

/// The verdict on a fit, and its numbers where they can be trusted. nominal_squares: of the fit
/// without warming.
Estimate Conclude(const Task& task, const RobustWarmFit& robust, double nominal_squares) {
  const Measurements& m = task.input.measurements;
  const WarmFit& fit = robust.fit;
  const Eigen::VectorXd torque = Kept(m.torque, task.input.selection);
  const auto p = static_cast<int>(fit.solution.x.size());
  const Eigen::Index d = fit.law_parameters;
  const double variance = fit.solution.squares / static_cast<double>(torque.size() - p);
  if (auto why =
          UntoldWarming(fit, task.scanned, variance, nominal_squares, Cofactor(fit.normal))) {
    return Failed(kName, Status::not_identifiable, *why);
  }
  if (!fit.converged) {
    return Failed(kName, Status::not_converged,
                  fmt::format("the fit still moves after {} iterations; {}", fit.trace.size() - 1,
                              WhyUnsettled(m, "warm-up")));
  }
  const LoopResponse response =
      task.loop.Simulate(fit.parameters(), fit.thermal(), fit.initial_energy(), fit.jump_values());
  if (response.feeds_itself) {
    return Failed(kName, Status::inadequate_model,
                  WouldFeedItself(m.time[*response.feeds_itself], "try another law"));
  }

  Estimate estimate;
  estimate.identifier = kName;
  const Eigen::VectorXd fitted =
      Kept(response.force + task.gravity.columns * fit.offset_values(), task.input.selection);
  estimate.metrics = ComputeMetrics(torque, fitted, p, p);
  const Uncertainty known = Judge(task, robust, torque - fitted, fitted);
  if (!known.covariance.allFinite()) {
    return Failed(kName, Status::bad_data, "torque or velocity is too large to square");
  }
  ReportLaw(task.law, fit.parameters(), known, m, estimate);
  ReportThermal(fit.thermal(), known.covariance.block<2, 2>(d, d), known.freedom, m, estimate);
  if (fit.estimates_initial_energy()) {
    estimate.parameters.push_back(WithInterval("initial_energy", fit.initial_energy(),
                                               m.torque_unit, known.Deviation(d + 2),
                                               known.freedom));
  }
  const Eigen::VectorXd jumps = fit.jump_values();
  for (Eigen::Index i = 0; i < jumps.size(); ++i) {
    const Eigen::Index place = p - fit.offsets - jumps.size() + i;
    estimate.parameters.push_back(WithInterval(fmt::format("energy_jump_{}", i + 1), jumps[i],
                                               m.torque_unit, known.Deviation(place),
                                               known.freedom));
  }
  ReportGravity(task.gravity, fit.solution.x, known, m, estimate);
  estimate.message = fmt::format("maximum likelihood on {} samples, refined in {} iterations{}{}",
                                 torque.size(), fit.trace.size() - 1,
                                 DescribeLoss(torque - fitted, robust.threshold), NoiseOf(known));
  if (!task.gaps.empty()) {
    estimate.warnings.push_back(
        fmt::format("{}: what the joint lost there is not known, and is estimated with the rest",
                    DescribeGaps(task.gaps, m)));
  }
  DescribeFriction(task.law, m, estimate);
  if (estimate.friction) estimate.friction->thermal = fit.thermal();
  return estimate;
}

/// A start for all linear parameters, law before gravity, and the warming: the scan over tau once
/// gravity is out of the loss. nominal: the fit without warming.
WarmStart Scan(const Measurements& m, const GravityFit& gravity, const ClosedLoop& loop,
               const Eigen::MatrixXd& columns, const LeastSquares& nominal,
               const Eigen::VectorXd& level, const Eigen::VectorXd& kept) {
  if (gravity.count() == 0) return ScanTimeConstant(loop, level, kept);
  const ClosedLoop together(m.time, m.velocity, columns, m.starts);
  const Eigen::VectorXd weight = nominal.solution.tail(gravity.count());
  const Eigen::VectorXd pull = gravity.columns * weight;
  WarmStart start = ScanTimeConstant(together, level - loop.direction().cwiseProduct(pull), kept);
  start.parameters.tail(gravity.count()) += weight;
  return start;
}

/// Squares that linear least squares leave. A: [n x d]; y: [n]
double LeftOver(const Eigen::MatrixXd& A, const Eigen::VectorXd& y) {
  const LeastSquares fit = SolveLeastSquares(A, y);
  return fit.mixed.empty() ? (y - A * fit.solution).squaredNorm() : kInfinity;
}

/// Fits once more, the jumps of E at the gaps too; from a fit without them, whose place it takes.
/// Returns how far they may be. [J]
Eigen::VectorXd FitJumps(const ClosedLoop& loop, const Eigen::VectorXd& level,
                         const Eigen::MatrixXd& offsets, const Eigen::VectorXd& kept,
                         const std::vector<LogGap>& gaps, WarmFit& fit) {
  const auto initial =
      fit.estimates_initial_energy() ? InitialEnergy::estimated : InitialEnergy::zero;
  const Thermal thermal = fit.thermal();
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(gaps.size()));
  const LoopResponse response =
      loop.Simulate(fit.parameters(), thermal, fit.initial_energy(), none);
  const Eigen::VectorXd spread =
      JumpSpread(gaps, response.energy.cwiseAbs().maxCoeff(), thermal.time_constant);
  const double scale = std::sqrt(fit.solution.squares / kept.sum());
  WarmStart start;
  start.parameters.resize(fit.law_parameters + fit.offsets);
  start.parameters << fit.parameters(), fit.offset_values();
  start.thermal = thermal;
  WarmFit next = FitWarmFriction(loop, level, offsets, kept, start, initial, scale,
                                 JumpWeights(scale, spread));
  next.trace.insert(next.trace.begin(), fit.trace.begin(), fit.trace.end());
  fit = std::move(next);
  return spread;
}

Estimate Identify(const IdentifierInput& given) {
  if (given.options.Text("position") != "none") return IdentifyWithMaps(kName, given);
  const Measurements& m = given.measurements;
  const LinearTask task = BeginLinear(given, kName, 3);
  if (task.refusal) return *task.refusal;
  const auto& [law, gravity, columns, refusal] = task;
  const IdentifierInput input = gravity.Of(given);

  // the columns of law and gravity must be distinct before any warming is thought of
  const Eigen::MatrixXd kept_columns = Kept(columns, input.selection);
  const Eigen::VectorXd torque = Kept(m.torque, input.selection);
  const LeastSquares nominal = SolveLeastSquares(kept_columns, torque);
  if (!nominal.mixed.empty()) {
    return Failed(kName, Status::not_identifiable,
                  IndistinctColumns(nominal.mixed, law, gravity, input));
  }
  double nominal_squares = (torque - kept_columns * nominal.solution).squaredNorm();

  // scan tau, then refine everything over the closed loop
  ClosedLoop loop(m.time, m.velocity, columns.leftCols(task.law_count()), m.starts);
  const Eigen::VectorXd level = loop.direction().cwiseProduct(m.torque);
  const Eigen::VectorXd kept = (input.selection.keep && m.velocity.array() != 0).cast<double>();
  const WarmStart start = Scan(m, gravity, loop, columns, nominal, level, kept);
  const auto initial = input.options.Text("initial_energy") == "estimated"
                           ? InitialEnergy::estimated
                           : InitialEnergy::zero;
  const double scale = std::sqrt(nominal_squares / static_cast<double>(torque.size()));
  const Eigen::MatrixXd offsets = loop.direction().asDiagonal() * gravity.columns;
  RobustWarmFit robust{FitWarmFriction(loop, level, offsets, kept, start, initial, scale), kept,
                       kInfinity};
  const std::vector<LogGap> gaps = FindGaps(m);
  Eigen::VectorXd spread;
  if (!gaps.empty()) {
    loop = loop.WithJumps(Behind(gaps));
    spread = FitJumps(loop, level, offsets, kept, gaps, robust.fit);
  }
  if (given.options.Text("loss") == "huber") {
    robust = RefineByHuber(loop, level, offsets, kept, std::move(robust.fit), spread);
    const Eigen::VectorXd root = Kept(robust.weight, input.selection).col(0).cwiseSqrt();
    nominal_squares = LeftOver(root.asDiagonal() * kept_columns, root.cwiseProduct(torque));
  }

  Estimate estimate = Conclude({input, law, gravity, loop, start, gaps}, robust, nominal_squares);
  estimate.trace = Trace(robust.fit, law, loop.intervals().typical, torque.size());
  return estimate;
}

}  // namespace

Identifier EnergyMl() {
  std::vector<OptionInfo> options = WarmMapOptions();
  options.insert(options.begin() + 1,
                 {{"initial_energy", "zero", "zero|estimated",
                   "E(0): 0 for a cold joint, or estimated at a cost of accuracy"},
                  GravityOption(),
                  LossOption()});
  return {kName,
          "law and warming together by maximum likelihood over the closed loop; needs no start",
          options, &Identify};
}

}  // namespace warmjoint::inline identification
