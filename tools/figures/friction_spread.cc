#include "tools/figures/friction_spread.h"

#include <Eigen/LU>
#include <cmath>

#include "identification/find_parameter.h"
#include "identification/fit_parameters.h"

namespace warmjoint::figures {
namespace {

constexpr double kRelativeStep = 1e-5;

/// Names of the parameters that the friction has and the estimate knows with a deviation.
std::vector<std::string> NamesOf(const Estimate& estimate) {
  std::vector<std::string> names;
  // only numbers that have a standard deviation can spread
  const auto add = [&](const std::string& name) {
    const EstimatedParameter* found = estimate.Find(name);
    if (found && found->std) names.push_back(name);
  };
  for (const auto& [name, value] : estimate.friction->parameters) add(name);
  if (estimate.friction->thermal) {
    for (const ParameterInfo& info : Thermal::parameters) add(std::string(info.name));
  }
  return names;
}

/// The number of a friction that a parameter of an estimate stands for.
double& NumberOf(Friction& friction, const std::string& name) {
  if (name == NameOf(Role::heat, 0)) return friction.thermal->gain;
  if (name == NameOf(Role::heat, 1)) return friction.thermal->time_constant;
  return friction.parameters.at(name);
}

/// dF/dp at the kept samples by central differences, [n x d].
Eigen::MatrixXd Derivatives(const Estimate& estimate, const std::vector<std::string>& names,
                            const JointCourse& course, const CourseStart& start,
                            const Selection& selection) {
  const Eigen::Index n = selection.count();
  Eigen::MatrixXd jacobian(n, static_cast<Eigen::Index>(names.size()));
  Friction friction = *estimate.friction;
  for (std::size_t i = 0; i < names.size(); ++i) {
    // central differences of the predicted force over each number
    const double value = NumberOf(friction, names[i]);
    const double step = kRelativeStep * std::max(std::abs(value), 1e-3);
    const auto force = [&](double change) -> Eigen::VectorXd {
      const AlongMotion changed(Changed(friction, names[i], change));
      return changed.Predict(course, start).force;
    };
    const Eigen::VectorXd up = force(step), down = force(-step);
    // only kept samples say anything
    Eigen::Index row = 0;
    for (Eigen::Index k = 0; k < course.time.size(); ++k) {
      if (selection.keep[k]) {
        jacobian(row++, static_cast<Eigen::Index>(i)) = (up[k] - down[k]) / (2 * step);
      }
    }
  }
  return jacobian;
}

}  // namespace

Friction Changed(const Friction& friction, const std::string& name, double step) {
  Friction changed = friction;
  NumberOf(changed, name) += step;
  return changed;
}

FrictionSpread SpreadOf(const Estimate& estimate, const JointCourse& course,
                        const CourseStart& start, const Selection& selection) {
  FrictionSpread spread;
  if (!estimate.friction) return spread;
  const std::vector<std::string> names = NamesOf(estimate);
  if (names.empty()) return spread;

  // correlations from the data, with columns of norm 1 so that units do not matter
  Eigen::MatrixXd jacobian = Derivatives(estimate, names, course, start, selection);
  const Eigen::VectorXd norms = jacobian.colwise().norm();
  jacobian = jacobian * norms.cwiseInverse().asDiagonal();
  const Eigen::FullPivLU<Eigen::MatrixXd> solver(jacobian.transpose() * jacobian);
  if (!jacobian.allFinite() || !solver.isInvertible()) return spread;
  const Eigen::MatrixXd cofactor = solver.inverse();

  // sizes from the estimate
  Eigen::VectorXd scale(static_cast<Eigen::Index>(names.size()));
  for (Eigen::Index i = 0; i < scale.size(); ++i) {
    scale[i] = *estimate.Find(names[static_cast<std::size_t>(i)])->std / std::sqrt(cofactor(i, i));
  }
  spread.names = names;
  spread.covariance = scale.asDiagonal() * cofactor * scale.asDiagonal();
  return spread;
}

}  // namespace warmjoint::figures
