#include "identification/identifiers/energy_ml.h"

#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "identification/fit_data.h"
#include "identification/fit_parameters.h"
#include "identification/lagged/lagged_fit.h"
#include "identification/linear/least_squares.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/linear_task.h"
#include "identification/linear/rigid_part.h"
#include "identification/linear/robust.h"
#include "identification/physical_bounds.h"
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

/// What all passes of a fit share.
struct Course {
  const IdentifierInput& input;  // without gravity where it is known
  const LinearTask& task;
  Eigen::MatrixXd kept_columns;  // [n x d] law, then gravity
  Eigen::VectorXd torque;        // [n] N.m or N
  LeastSquares nominal;          // without warming
  Selection moving;              // of the kept samples
  Eigen::VectorXd kept;          // [N] 1 where moving
  ClosedLoop loop;
  Eigen::VectorXd level;    // [N] sign(v) torque
  Eigen::MatrixXd offsets;  // [N x q] sign(v) dG/dg
  std::vector<LogGap> gaps;
  Eigen::VectorXd spread;  // [J] of the jumps at gaps
  std::string
      unlike_before;  // the clause that the log contradicts the start that was expected; or empty

  Course(const IdentifierInput& from, const LinearTask& linear)
      : input(from),
        task(linear),
        kept_columns(Kept(task.columns, input.selection)),
        torque(Kept(input.measurements.torque, input.selection)),
        nominal(SolveLeastSquares(kept_columns, torque)),
        moving(WithoutRest(input.selection, input.measurements)),
        kept(moving.keep.cast<double>()),
        loop(ClosedLoop::Along(input.measurements, task.columns.leftCols(task.law_count()),
                               LossColumns(task.law, input.measurements))),
        level(loop.direction().cwiseProduct(input.measurements.torque)),
        offsets(loop.direction().asDiagonal() * task.gravity.columns) {}

  double NominalSquares() const { return (torque - kept_columns * nominal.solution).squaredNorm(); }
};

/// A start for all linear parameters, law before gravity, and the warming: the scan over tau once
/// gravity is out of the loss. level: [N] as Course::level
WarmStart Scan(const Course& course, const Eigen::VectorXd& level) {
  const RigidPart& gravity = course.task.gravity;
  if (gravity.count() == 0) return ScanTimeConstant(course.loop, level, course.kept);

  // gravity of the fit without warming is taken off, and what that lacks scanned with the law
  const ClosedLoop together = ClosedLoop::Along(course.input.measurements, course.task.columns);
  const Eigen::VectorXd weight = course.nominal.solution.tail(gravity.count());
  const Eigen::VectorXd pull = gravity.columns * weight;
  WarmStart start =
      ScanTimeConstant(together, level - course.loop.direction().cwiseProduct(pull), course.kept);
  start.parameters.tail(gravity.count()) += weight;
  return start;
}

/// Squares that linear least squares leave. A: [n x d]; y: [n]
double LeftOver(const Eigen::MatrixXd& A, const Eigen::VectorXd& y) {
  const LeastSquares fit = SolveLeastSquares(A, y);
  return fit.mixed.empty() ? (y - A * fit.solution).squaredNorm() : kInfinity;
}

/// How sure a fit to plain squares is of its x, whatever the colour of the noise.
Uncertainty KnownOf(const Course& course, const WarmFit& plain) {
  const auto& [input, gravity] = std::tie(course.input, course.task.gravity);
  const LoopResponse response = course.loop.Simulate(plain.parameters(), plain.thermal(),
                                                     plain.initial_energy(), plain.jump_values());
  const Eigen::VectorXd fitted = response.force + gravity.columns * plain.offset_values();
  const Eigen::VectorXd residual = Kept(input.measurements.torque - fitted, input.selection);
  return JudgeUncertainty(Kept(WarmJacobian(course.loop, gravity, plain), input.selection),
                          Cofactor(plain.normal), residual, input.selection, {}, plain.prior());
}

/// What whitening changes of a fit beyond doubt; nothing where the colour may be noise. plain: the
/// fit before it.
std::optional<Disagreement> FindStructure(const Course& course, const WarmFit& plain,
                                          const WarmFit& white, const Whitening& whitening) {
  const Uncertainty known = KnownOf(course, plain);
  return FindDisagreement({plain.solution.x, known.covariance},
                          {white.solution.x, whitening.noise().innovation * Cofactor(white.normal)},
                          known.freedom);
}

/// What the pass on whitened rows came to.
struct Whitened {
  std::shared_ptr<const Whitening> map;  // of the fit's rows; none where they are as they were
  std::optional<Disagreement> refused;   // why not, though the noise is coloured
};

/// Fits once more on whitened rows, where the noise is coloured beyond doubt; the fit stays as it was
/// where that changes more than noise may.
Whitened FitAgainWhitened(const Course& course, WarmFit& fit) {
  const Measurements& m = course.input.measurements;
  const WarmFit plain = fit;
  Whitened white;
  white.map = FitWhitened(m, course.input.selection, course.loop, course.level, course.offsets,
                          course.spread, fit);
  if (!white.map) return white;

  // back to the plain fit where whitening changes too much, or leaves the bounds
  white.refused = FindStructure(course, plain, fit, *white.map);
  if (white.refused || LeavesBounds(LawParameters(course.task.law, fit.parameters(), m))) {
    fit = plain;
    white.map = nullptr;
  }
  return white;
}

/// By plain squares, with what is known of E(0) and a jump of E at each gap, both of which the course learns.
RobustWarmFit FitBySquares(Course& course, const WarmStart& start) {
  // first without gaps, with E(0) as the options have it
  const double scale =
      std::sqrt(course.NominalSquares() / static_cast<double>(course.torque.size()));
  RobustWarmFit robust{FitWarmFriction(course.loop, course.level, course.offsets, course.kept,
                                       start, InitialEnergyOf(course.input.options), scale),
                       course.kept, kInfinity};

  // what was known of E(0), weighed by the noise that this fit leaves
  course.unlike_before = WeighStart(
      course.loop, course.level, course.offsets, course.kept,
      [&](const WarmFit& alone) {
        return KnownOf(course, alone).Deviation(alone.law_parameters + 2);
      },
      robust.fit);

  // nobody knows the losses within gaps: E may jump there
  course.gaps = FindGaps(course.input.measurements);
  if (!course.gaps.empty()) {
    course.spread = FitJumps(course.loop, course.level, course.offsets, course.kept, course.gaps,
                             start, robust.fit);
  }
  return robust;
}

/// The passes after the first: under Huber's loss, behind the lag of the torque, or on whitened rows where the
/// noise is coloured beyond doubt.
Fit FitFurther(const Course& course, const WarmStart& start, RobustWarmFit robust) {
  const auto& [input, task] = std::tie(course.input, course.task);
  double nominal_squares = course.NominalSquares();
  // outliers count less, in the fit without warming as well
  if (input.options.Text("loss") == "huber") {
    robust = RefineByHuber(course.loop, course.level, course.offsets, course.kept,
                           std::move(robust.fit), course.spread);
    const Eigen::VectorXd root = Kept(robust.weight, input.selection).col(0).cwiseSqrt();
    nominal_squares =
        LeftOver(root.asDiagonal() * course.kept_columns, root.cwiseProduct(course.torque));
  }

  // samples at rest, which tell nothing, would part the rows of the fit from those of its errors
  const bool by_squares =
      std::isinf(robust.threshold) && course.moving.count() == input.selection.count();
  std::shared_ptr<const LaggedRows> lag;
  if (by_squares && AsksForLag(input)) {
    lag = FitBehindLag(
        input.measurements, course.moving, course.loop, course.offsets, course.spread,
        [&](const Eigen::VectorXd& level) { return Scan(course, level); }, robust.fit);
  }
  Whitened whitened;
  if (by_squares && !lag) whitened = FitAgainWhitened(course, robust.fit);

  // the fit without warming, on the same rows
  if (lag)
    nominal_squares = LeftOver(lag->Of(course.kept_columns), lag->Of(lag->Unlagged(course.torque)));
  if (const auto& map = whitened.map)
    nominal_squares = LeftOver(map->Of(course.kept_columns), map->Of(course.torque));
  return ConcludeWarm(kName,
                      {input, task.law, task.gravity, course.loop, start, course.gaps, whitened.map,
                       whitened.refused, lag},
                      robust, nominal_squares);
}

Fit FitWarming(const IdentifierInput& given) {
  if (auto why = WhyNoLag(given)) return Refused(kName, Status::bad_data, *why);
  const LinearTask task = BeginLinear(given, 3);
  if (task.refusal) return Refused(kName, *task.refusal);
  const IdentifierInput input = task.gravity.Of(given);

  // the columns of law and gravity must be distinct before any warming is thought of
  Course course(input, task);
  if (!course.nominal.mixed.empty()) {
    return Refused(kName, Status::not_identifiable,
                   IndistinctColumns(course.nominal.mixed, task.law, task.gravity, input));
  }

  // scan tau, then refine everything over the closed loop
  const WarmStart start = Scan(course, course.level);
  RobustWarmFit robust = FitBySquares(course, start);
  Fit fit = FitFurther(course, start, std::move(robust));
  if (!course.unlike_before.empty()) fit.warnings.push_back(course.unlike_before);
  return fit;
}

}  // namespace

Identifier EnergyMl() {
  std::vector<OptionInfo> options{LawOption()};
  for (const OptionInfo& option : InitialEnergyOptions()) options.push_back(option);
  options.insert(options.end(), {GravityOption(), MotionOption(), LossOption(), TorqueLagOption()});
  return {kName,
          "law and warming together by maximum likelihood over the closed loop; needs no start",
          options, &FitWarming};
}

}  // namespace warmjoint::inline identification
