#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "models/foundation/random_stream.h"
#include "tools/figures/run/error_by_iteration.h"
#include "tools/figures/run/run_figures.h"

namespace warmjoint::figures {
namespace {

/// Median of |x| of a normal x with covariance C [d x d], by 20001 draws that are always the same: known
/// to 1 %. Where C is the bound of relative errors, the median NPE of an estimator that stands at it.
double MedianNormOf(const Eigen::MatrixXd& covariance) {
  constexpr std::size_t kDraws = 20001;
  // errors at the bound are normal with this covariance
  const Eigen::MatrixXd root = covariance.llt().matrixL();
  RandomStream random({1, 0}, Stream::truth);
  std::vector<double> norms(kDraws);
  Eigen::VectorXd draw(covariance.rows());
  // the median of their norms has no formula and is drawn
  for (double& norm : norms) {
    for (double& value : draw) value = random.Normal();
    norm = (root * draw).norm();
  }
  std::nth_element(norms.begin(), norms.begin() + kDraws / 2, norms.end());
  return norms[kDraws / 2];
}

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

}  // namespace warmjoint::figures
