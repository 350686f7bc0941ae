#include "identification/warming/warm_course.h"

#include <warmjoint/recording.h>

#include <cmath>
#include <tuple>
#include <utility>

#include "identification/fit_data.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/rigid_part.h"
#include "identification/warming/expected_start.h"
#include "identification/warming/further_passes.h"
#include "identification/warming/warm_answer.h"
#include "models/recording/measurements.h"

namespace warmjoint {

namespace {

/// Of least squares that are solved.
double LeftOver(const Eigen::MatrixXd& A, const Eigen::VectorXd& y, const LeastSquares& fit) {
  return fit.mixed.empty() ? (y - A * fit.solution).squaredNorm() : kInfinity;
}

}  // namespace

WarmCourse::WarmCourse(const IdentifierInput& from, const LinearTask& linear)
    : input(from),
      task(linear),
      kept_columns(Kept(task.columns, input.selection)),
      torque(Kept(input.measurements.torque, input.selection)),
      nominal(SolveLeastSquares(kept_columns, torque)),
      nominal_squares(LeftOver(kept_columns, torque, nominal)),
      moving(WithoutRest(input.selection, input.measurements)),
      kept(moving.keep.cast<double>()),
      loop(ClosedLoop::Along(input.measurements, task.columns.leftCols(task.law_count()),
                             LossColumns(task.law, input.measurements))),
      level(loop.direction().cwiseProduct(input.measurements.torque)),
      offsets(loop.direction().asDiagonal() * task.gravity.columns) {}

InitialGuess Scan(const WarmCourse& course, const Eigen::VectorXd& level) {
  const RigidPart& gravity = course.task.gravity;
  if (gravity.count() == 0) return ScanTimeConstant(course.loop, level, course.kept);

  // gravity of the fit without warming is taken off, and what that lacks scanned with the law
  const ClosedLoop together = ClosedLoop::Along(course.input.measurements, course.task.columns);
  const Eigen::VectorXd weight = course.nominal.solution.tail(gravity.count());
  const Eigen::VectorXd gravity_torque = gravity.columns * weight;
  InitialGuess start = ScanTimeConstant(
      together, level - course.loop.direction().cwiseProduct(gravity_torque), course.kept);
  start.parameters.tail(gravity.count()) += weight;
  return start;
}

double LeftOver(const Eigen::MatrixXd& A, const Eigen::VectorXd& y) {
  return LeftOver(A, y, SolveLeastSquares(A, y));
}

Uncertainty KnownOf(const WarmCourse& course, const WarmFit& plain) {
  const auto& [input, gravity] = std::tie(course.input, course.task.gravity);
  const LoopResponse response = WarmResponse(course.loop, plain);
  const Eigen::VectorXd fitted = response.force + gravity.columns * plain.offset_values();
  const Eigen::VectorXd residual = Kept(input.measurements.torque - fitted, input.selection);
  return JudgeUncertainty(Kept(WarmJacobian(course.loop, gravity, plain), input.selection),
                          Cofactor(plain.normal), residual, input.selection, {}, plain.prior());
}

namespace {

/// By plain squares, with what is known of E(0) and a jump of E at each gap, both of which the course learns.
RobustWarmFit FitBySquares(WarmCourse& course, const InitialGuess& start) {
  // first without gaps, with E(0) as the options have it
  const double scale =
      std::sqrt(course.nominal_squares / static_cast<double>(course.torque.size()));
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

}  // namespace

Fit FitLawAndWarming(const char* name, const IdentifierInput& given, const LaterPasses& go_on) {
  const LinearTask task = BeginLinear(given, 3);
  if (task.refusal) return Refused(name, *task.refusal);
  const IdentifierInput input = task.gravity.Of(given);

  // the columns of law and gravity must be distinct before any warming is thought of
  WarmCourse course(input, task);
  if (!course.nominal.mixed.empty()) {
    return Refused(name, Status::not_identifiable,
                   IndistinctColumns(course.nominal.mixed, task.law, task.gravity, input));
  }

  // scan tau, then refine everything over the closed loop
  const InitialGuess start = Scan(course, course.level);
  RobustWarmFit robust = FitBySquares(course, start);
  Fit fit = go_on(course, start, std::move(robust));
  if (!course.unlike_before.empty()) fit.warnings.push_back(course.unlike_before);
  return fit;
}

}  // namespace warmjoint
