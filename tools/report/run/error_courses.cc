#include <cmath>

#include "tools/report/figures/error_by_iteration.h"
#include "tools/report/run/median_bound.h"
#include "tools/report/run/run_figures.h"

namespace warmjoint::report {
namespace {

/// The final values as a course of one iteration, 0.
QuartileCurve Level(const Eigen::VectorXd& values) {
  return QuartilesOf(Eigen::VectorXd::Zero(1), values);
}

IdentifierCourse CourseOf(const RunRow& row) {
  IdentifierCourse course{row.label, row.identifier, {}, {}};
  if (row.course.iteration.size() > 0) {
    course.npe = QuartilesOf(row.course.iteration, row.course.npe);
    course.rmse = QuartilesOf(row.course.iteration, row.course.rmse);
  } else if (row.npe.array().isFinite().any()) {
    course.npe = Level(row.npe);
    course.rmse = Level(row.rmse);
  }
  return course;
}

}  // namespace

std::optional<Figure> ErrorCourses(const RunView& run) {
  ErrorByIteration data;
  data.suite = run.suite;
  data.realizations = run.realizations;
  data.torque_unit = run.torque_unit;
  bool any = false;
  // courses of all identifiers, of which one at least has to iterate
  for (const RunRow& row : run.rows) {
    data.identifiers.push_back(CourseOf(row));
    any = any || row.course.iteration.size() > 1;
  }
  if (!any) return std::nullopt;
  // a median to compare medians with; variants have a bound each
  if (run.bound_covariance.size() > 0 && run.rungs.values.size() < 2) {
    data.cramer_rao = MedianNormOf(run.bound_covariance) / 100;
  }
  if (std::isfinite(run.noise) && run.noise > 0) data.noise = run.noise;
  return MakeErrorByIteration(data);
}

}  // namespace warmjoint::report
