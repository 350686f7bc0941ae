#include "identification/warming/thermal_fit_context.h"

#include <warmjoint/recording.h>

#include <cmath>
#include <tuple>
#include <utility>

#include "identification/fit_data.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/rigid_part.h"
#include "identification/warming/conclude_thermal_fit.h"
#include "models/recording/measurements.h"

namespace warmjoint {

namespace {

/// Of least squares that are solved.
double LeftOver(const Eigen::MatrixXd& A, const Eigen::VectorXd& y, const LeastSquares& fit) {
  return fit.mixed.empty() ? (y - A * fit.solution).squaredNorm() : kInfinity;
}

}  // namespace

ThermalFitContext::ThermalFitContext(const IdentifierInput& from, const LinearTask& linear)
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

InitialGuess Scan(const ThermalFitContext& course, const Eigen::VectorXd& level) {
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

Uncertainty CovarianceOf(const ThermalFitContext& course, const ThermalFit& plain) {
  const auto& [input, gravity] = std::tie(course.input, course.task.gravity);
  const LoopResponse response = WarmResponse(course.loop, plain);
  const Eigen::VectorXd fitted = response.force + gravity.columns * plain.offset_values();
  const Eigen::VectorXd residual = Kept(input.measurements.torque - fitted, input.selection);
  return EstimateCovariance(Kept(WarmJacobian(course.loop, gravity, plain), input.selection),
                            Cofactor(plain.normal), residual, input.selection, {}, plain.prior());
}

}  // namespace warmjoint
