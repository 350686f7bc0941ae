#include "identification/identifiers/energy_ml.h"

#include <cmath>

#include "identification/fit_data.h"
#include "identification/fit_parameters.h"
#include "identification/inference/bounds.h"
#include "identification/lagged/lagged_fit.h"
#include "identification/linear/least_squares.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/linear_task.h"
#include "identification/linear/rigid_part.h"
#include "identification/linear/robust.h"
#include "identification/maps/energy_ml_maps.h"
#include "identification/uncertainty/disagreement.h"
#include "identification/warming/expected_start.h"
#include "identification/warming/further_passes.h"
#include "identification/warming/gaps.h"
#include "identification/warming/lagged_warm_fit.h"
#include "identification/warming/robust_warm_fit.h"
#include "identification/warming/scan_time_constant.h"
#include "identification/warming/warm_answer.h"
#include "models/recording/without_rest.h"

namespace warmjoint::inline identification {
namespace {

constexpr const char* kName = "energy-ml";

/// A start for all linear parameters, law before gravity, and the warming: the scan over tau once
/// gravity is out of the loss. nominal: the fit without warming.
WarmStart Scan(const Measurements& m, const RigidPart& gravity, const ClosedLoop& loop,
               const Eigen::MatrixXd& columns, const LeastSquares& nominal,
               const Eigen::VectorXd& level, const Eigen::VectorXd& kept) {
  if (gravity.count() == 0) return ScanTimeConstant(loop, level, kept);
  const ClosedLoop together = ClosedLoop::Along(m, columns);
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
  return JudgeUncertainty(Kept(WarmJacobian(loop, gravity, plain), input.selection),
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

/// What the pass on whitened rows came to.
struct Whitened {
  std::shared_ptr<const Whitening> map;  // of the fit's rows; none where they are as they were
  std::optional<Disagreement> refused;   // why not, though the noise is coloured
};

/// What FitWarmFriction takes beside the loop.
struct WarmRows {
  const Eigen::VectorXd& level;    // [N]
  const Eigen::MatrixXd& offsets;  // [N x q]
  const Eigen::VectorXd& spread;   // [J] of jumps
};

/// Fits once more on whitened rows, where the noise is coloured beyond doubt; the fit stays as it was
/// where that changes more than noise may.
Whitened FitAgainWhitened(const IdentifierInput& input, const RigidPart& gravity,
                          const ClosedLoop& loop, const Law& law, const WarmRows& rows,
                          WarmFit& fit) {
  const Measurements& m = input.measurements;
  const WarmFit plain = fit;
  Whitened white;
  white.map = FitWhitened(m, input.selection, loop, rows.level, rows.offsets, rows.spread, fit);
  if (!white.map) return white;
  white.refused = FindStructure(input, gravity, loop, plain, fit, *white.map);
  if (white.refused || LeavesBounds(LawParameters(law, fit.parameters(), m))) {
    fit = plain;
    white.map = nullptr;
  }
  return white;
}

Fit FitWarming(const IdentifierInput& given) {
  if (auto why = WhyNoLag(given)) return Refused(kName, Status::bad_data, *why);
  if (given.options.Text("position") != "none") {
    if (!AsksForLag(given)) return FitWithMaps(kName, given);
    return Refused(kName, Status::bad_data,
                   "torque_lag is estimated beside a law without maps; use position none, or "
                   "torque_lag none");
  }
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
  ClosedLoop loop = ClosedLoop::Along(m, columns.leftCols(task.law_count()), LossColumns(law, m));
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

  // once more behind the lag of the torque, or where the noise is coloured beyond doubt; samples at rest, which
  // tell nothing, would part the rows of the fit from those of its errors
  const bool by_squares = std::isinf(robust.threshold) && moving.count() == input.selection.count();
  std::shared_ptr<const LaggedRows> lag;
  if (by_squares && AsksForLag(given)) {
    const auto scan = [&](const Eigen::VectorXd& at) {
      return Scan(m, gravity, loop, columns, nominal, at, kept);
    };
    lag = FitBehindLag(m, moving, loop, offsets, spread, scan, robust.fit);
  }
  Whitened whitened;
  if (by_squares && !lag) {
    whitened = FitAgainWhitened(input, gravity, loop, law, {level, offsets, spread}, robust.fit);
  }
  if (lag) nominal_squares = LeftOver(lag->Of(kept_columns), lag->Of(lag->Unlagged(torque)));
  if (const auto& map = whitened.map)
    nominal_squares = LeftOver(map->Of(kept_columns), map->Of(torque));

  Fit fit = ConcludeWarm(
      kName, {input, law, gravity, loop, start, gaps, whitened.map, whitened.refused, lag}, robust,
      nominal_squares);
  if (!unlike_before.empty()) fit.warnings.push_back(unlike_before);
  return fit;
}

}  // namespace

Identifier EnergyMl() {
  std::vector<OptionInfo> options = WarmMapOptions();
  options.insert(options.begin() + 1,
                 {GravityOption(), MotionOption(), LossOption(), TorqueLagOption()});
  const std::vector<OptionInfo> start = InitialEnergyOptions();
  options.insert(options.begin() + 1, start.begin(), start.end());
  return {kName,
          "law and warming together by maximum likelihood over the closed loop; needs no start",
          options, &FitWarming};
}

}  // namespace warmjoint::inline identification
