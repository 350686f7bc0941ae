#include "identification/identifiers/energy_ml.h"

#include <fmt/format.h>

#include <cmath>

#include "identification/fit_data.h"
#include "identification/fit_parameters.h"
#include "identification/inference/bounds.h"
#include "identification/inference/hold_structure.h"
#include "identification/linear/against_pushing.h"
#include "identification/linear/least_squares.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/linear_task.h"
#include "identification/linear/rigid_part.h"
#include "identification/linear/robust.h"
#include "identification/maps/energy_ml_maps.h"
#include "identification/uncertainty/disagreement.h"
#include "identification/uncertainty/few_segments.h"
#include "identification/uncertainty/tails.h"
#include "identification/warming/expected_start.h"
#include "identification/warming/further_passes.h"
#include "identification/warming/gaps.h"
#include "identification/warming/robust_warm_fit.h"
#include "identification/warming/scan_time_constant.h"
#include "identification/warming/unsettled.h"
#include "identification/warming/warming_verdict.h"
#include "models/recording/without_rest.h"

namespace warmjoint::inline identification {
namespace {

constexpr const char* kName = "energy-ml";

/// Why the warm-up cannot be told; nothing where it can. variance: of the noise; cofactor: of x;
/// nominal_squares: of the fit without warming; reach: of 95 % intervals in deviations, as a multiple
/// of that of a known variance.
std::optional<std::string> UntoldWarming(const WarmFit& fit, const WarmStart& scanned,
                                         double variance, double nominal_squares,
                                         const Eigen::MatrixXd& cofactor, double reach) {
  const double explained = (nominal_squares - fit.solution.squares) / variance;
  if (!fit.converged) {
    if (auto why = UnseenWarming(explained)) return why;
    return RunawayWarming(fit.thermal().time_constant, scanned.longest / kScannedBeyond);
  }
  const Eigen::Index i = fit.law_parameters + 1;
  return UnknownWarming({explained, reach * std::sqrt(variance * cofactor(i, i)),
                         fit.thermal().time_constant, scanned.shortest, scanned.longest,
                         scanned.longest / kScannedBeyond});
}

/// The table of parameters in the order of x: law, heat, E(0), jumps, gravity.
void FillTable(const WarmFit& warm, const Law& law, const RigidPart& gravity, const Measurements& m,
               Fit& fit) {
  fit.parameters = LawParameters(law, warm.parameters(), m);
  Append(HeatParameters(warm.thermal(), m), fit);
  if (warm.estimates_initial_energy()) Append({StartParameter(warm.initial_energy(), m)}, fit);
  Append(JumpParameters(warm.jump_values(), m), fit);
  AddRigid(gravity, warm.offset_values(), m, fit);
}

std::vector<Iterate> Trace(const WarmFit& warm, Eigen::Index n) {
  std::vector<Iterate> trace;
  for (const WarmIterate& iterate : warm.trace) {
    Iterate& entry = trace.emplace_back();
    entry.iteration = static_cast<int>(trace.size()) - 1;
    entry.rmse = std::sqrt(iterate.squares / static_cast<double>(n));
    const Eigen::Index d = warm.law_parameters;
    entry.values.assign(iterate.x.begin(), iterate.x.begin() + d + 2);
    entry.values.back() = std::exp(entry.values.back());
  }
  return trace;
}

/// d(F + G)/dx over all samples, [N x p].
Eigen::MatrixXd Jacobian(const ClosedLoop& loop, const RigidPart& gravity, const WarmFit& fit) {
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
  const RigidPart& gravity;
  const ClosedLoop& loop;
  const WarmStart& scanned;
  const std::vector<LogGap>& gaps;
  std::shared_ptr<const Whitening> whitening;
  std::optional<Disagreement> structure;  // why the rows were not whitened
};

/// What the errors of a fit follow from, whatever its loss. residual: [n]
ErrorModel ErrorsOf(const Task& task, const RobustWarmFit& robust,
                    const Eigen::VectorXd& residual) {
  ErrorModel errors;
  errors.prior = robust.fit.prior();
  if (std::isinf(robust.threshold)) {
    errors.cofactor = Cofactor(robust.fit.normal);
    errors.whitening = task.whitening;
    return errors;
  }
  const Eigen::MatrixXd rows =
      Kept(Jacobian(task.loop, task.gravity, robust.fit), task.input.selection);
  Eigen::MatrixXd normal = rows.transpose() * rows;
  normal.diagonal() += errors.prior;
  errors.cofactor = Cofactor(normal);
  errors.scores = HuberScores(residual, robust.threshold);
  return errors;
}

/// Why there is no fit to trust; nothing where there is. nominal_squares: of the fit without
/// warming.
std::optional<Refusal> WhyRefused(const Task& task, const WarmFit& warm, double nominal_squares,
                                  const LoopResponse& response) {
  const Measurements& m = task.input.measurements;
  const auto n = task.input.selection.count();
  const double variance = warm.solution.squares / static_cast<double>(n - warm.solution.x.size());
  const auto p = warm.solution.x.size();
  const double reach = StudentQuantile(FewestFreedom(task.input.selection, p), kIntervalLevel) /
                       StudentQuantile(kInfinity, kIntervalLevel);
  if (auto why = UntoldWarming(warm, task.scanned, variance, nominal_squares, Cofactor(warm.normal),
                               reach)) {
    return Refusal{Status::not_identifiable, *why};
  }
  if (!warm.converged) {
    return Refusal{Status::not_converged,
                   fmt::format("the fit has not converged after {} iterations; {}",
                               warm.trace.size() - 1, WhyUnsettled(m, FrictionKind::warm_up))};
  }
  if (response.feeds_itself) {
    return Refusal{
        Status::inadequate_model,
        WouldFeedItself(m.time[*response.feeds_itself],
                        AgainstPushing(kName, task.law.name, task.input.options.Text("gravity")))};
  }
  return std::nullopt;
}

/// The fit as a value. nominal_squares: of the fit without warming.
Fit Conclude(const Task& task, const RobustWarmFit& robust, double nominal_squares) {
  const IdentifierInput& input = task.input;
  const Measurements& m = input.measurements;
  const WarmFit& warm = robust.fit;
  const LoopResponse response = task.loop.Simulate(warm.parameters(), warm.thermal(),
                                                   warm.initial_energy(), warm.jump_values());
  Fit fit;
  fit.identifier = kName;
  fit.trace = Trace(warm, input.selection.count());
  fit.refusal = WhyRefused(task, warm, nominal_squares, response);
  FillTable(warm, task.law, task.gravity, m, fit);
  if (fit.refusal) return fit;

  // the model
  fit.friction = FrictionOf(task.law, warm.parameters(), m);
  fit.friction.thermal = warm.thermal();
  fit.initial_energy = warm.initial_energy();
  fit.jump_samples = task.loop.jumps();

  // and how well it fits
  fit.used = input.selection;
  fit.torque = Kept(m.torque, fit.used);
  fit.fitted = Kept(response.force + task.gravity.columns * warm.offset_values(), fit.used);
  fit.errors = ErrorsOf(task, robust, fit.residual());
  fit.jacobian = [loop = task.loop, gravity = task.gravity, warm] {
    return Jacobian(loop, gravity, warm);
  };
  if (task.structure) HoldStructure(*task.structure, Kept(response.force, fit.used), fit);
  fit.count = static_cast<int>(warm.solution.x.size());
  fit.effective_parameters = fit.count;
  if (!std::isinf(robust.threshold)) fit.loss_bend = robust.threshold;
  fit.summary = fmt::format("maximum likelihood on {} samples{}{}, refined in {} iterations",
                            fit.torque.size(), m.acceleration ? kOfAnyMotion : "",
                            task.whitening ? kWhitened : "", warm.trace.size() - 1);
  if (!task.gaps.empty()) {
    fit.warnings.push_back(
        fmt::format("{}: the losses during that time are unknown and are estimated, too",
                    DescribeGaps(task.gaps, m)));
  }
  return fit;
}

/// A start for all linear parameters, law before gravity, and the warming: the scan over tau once
/// gravity is out of the loss. nominal: the fit without warming.
WarmStart Scan(const Measurements& m, const RigidPart& gravity, const ClosedLoop& loop,
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

/// How sure a fit to plain squares is of its x, whatever the colour of the noise.
Uncertainty KnownOf(const IdentifierInput& input, const RigidPart& gravity, const ClosedLoop& loop,
                    const WarmFit& plain) {
  const LoopResponse response = loop.Simulate(plain.parameters(), plain.thermal(),
                                              plain.initial_energy(), plain.jump_values());
  const Eigen::VectorXd fitted = response.force + gravity.columns * plain.offset_values();
  const Eigen::VectorXd residual = Kept(input.measurements.torque - fitted, input.selection);
  return JudgeUncertainty(Kept(Jacobian(loop, gravity, plain), input.selection),
                          Cofactor(plain.normal), residual, input.selection, {}, plain.prior());
}

/// What whitening changes of a fit beyond doubt; nothing where the colour may be noise. plain: the
/// fit before it.
std::optional<Disagreement> FindStructure(const IdentifierInput& input, const RigidPart& gravity,
                                          const ClosedLoop& loop, const WarmFit& plain,
                                          const WarmFit& white, const Whitening& whitening) {
  const Uncertainty known = KnownOf(input, gravity, loop, plain);
  return FindDisagreement({plain.solution.x, known.covariance},
                          {white.solution.x, whitening.noise().innovation * Cofactor(white.normal)},
                          known.freedom);
}

Fit FitWarming(const IdentifierInput& given) {
  if (given.options.Text("position") != "none") return FitWithMaps(kName, given);
  const Measurements& m = given.measurements;
  const LinearTask task = BeginLinear(given, 3);
  if (task.refusal) return Refused(kName, *task.refusal);
  const auto& [law, gravity, columns, refusal] = task;
  const IdentifierInput input = gravity.Of(given);

  // the columns of law and gravity must be distinct before any warming is thought of
  const Eigen::MatrixXd kept_columns = Kept(columns, input.selection);
  const Eigen::VectorXd torque = Kept(m.torque, input.selection);
  const LeastSquares nominal = SolveLeastSquares(kept_columns, torque);
  if (!nominal.mixed.empty()) {
    return Refused(kName, Status::not_identifiable,
                   IndistinctColumns(nominal.mixed, law, gravity, input));
  }
  double nominal_squares = (torque - kept_columns * nominal.solution).squaredNorm();

  // scan tau, then refine everything over the closed loop
  ClosedLoop loop(m.time, m.velocity, columns.leftCols(task.law_count()), m.starts);
  const Eigen::VectorXd level = loop.direction().cwiseProduct(m.torque);
  const Selection moving = WithoutRest(input.selection, m);
  const Eigen::VectorXd kept = moving.keep.cast<double>();
  const WarmStart start = Scan(m, gravity, loop, columns, nominal, level, kept);
  const double scale = std::sqrt(nominal_squares / static_cast<double>(torque.size()));
  const Eigen::MatrixXd offsets = loop.direction().asDiagonal() * gravity.columns;
  RobustWarmFit robust{
      FitWarmFriction(loop, level, offsets, kept, start, InitialEnergyOf(input.options), scale),
      kept, kInfinity};
  const std::string unlike_before = WeighStart(
      loop, level, offsets, kept,
      [&](const WarmFit& alone) {
        return KnownOf(input, gravity, loop, alone).Deviation(alone.law_parameters + 2);
      },
      robust.fit);
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

  // once more where the noise is coloured beyond doubt; samples at rest, which tell nothing, would
  // part the rows of the fit from those of its errors
  std::shared_ptr<const Whitening> whitening;
  std::optional<Disagreement> structure;
  const bool all_move = moving.count() == input.selection.count();
  if (std::isinf(robust.threshold) && all_move) {
    WarmFit plain = robust.fit;
    whitening = FitWhitened(m, moving, loop, level, offsets, spread, robust.fit);
    if (whitening) structure = FindStructure(input, gravity, loop, plain, robust.fit, *whitening);
    if (structure || (whitening && LeavesBounds(LawParameters(law, robust.fit.parameters(), m)))) {
      robust.fit = std::move(plain);
      whitening = nullptr;
    }
  }
  if (whitening) nominal_squares = LeftOver(whitening->Of(kept_columns), whitening->Of(torque));

  Fit fit = Conclude({input, law, gravity, loop, start, gaps, whitening, structure}, robust,
                     nominal_squares);
  if (!unlike_before.empty()) fit.warnings.push_back(unlike_before);
  return fit;
}

}  // namespace

Identifier EnergyMl() {
  std::vector<OptionInfo> options = WarmMapOptions();
  options.insert(options.begin() + 1, {GravityOption(), MotionOption(), LossOption()});
  const std::vector<OptionInfo> start = InitialEnergyOptions();
  options.insert(options.begin() + 1, start.begin(), start.end());
  return {kName,
          "law and warming together by maximum likelihood over the closed loop; needs no start",
          options, &FitWarming};
}

}  // namespace warmjoint::inline identification
