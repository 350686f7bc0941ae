#include "tools/compensate/arms/arm_list.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/robust_noise.h"
#include "models/friction/sign.h"

namespace warmjoint {

const std::vector<CompensatorArm>& CompensatorArms() {
  static const std::vector<CompensatorArm> arms{
      NoCompensation(),   FixedFriction(),    ForgettingLeastSquares(), AdaptingLevel(),
      PolynomialInHeat(), FrictionWithHeat(), TrueFriction(),
  };
  return arms;
}

const CompensatorArm& FindCompensator(const std::string& name) {
  std::vector<std::string> known;
  for (const CompensatorArm& arm : CompensatorArms()) {
    if (arm.name == name) return arm;
    known.push_back(arm.name);
  }
  Refuse({}, "there is no compensator '{}'{}", Excerpt(name), Suggestion(name, known));
}

double SpeedLine::At(double velocity) const { return viscous * velocity + level * Sign(velocity); }

SpeedLine LineOf(const LogSamples& log, double begin, double end) {
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (Eigen::Index i = 0; i < log.size(); ++i) {
    if (log.velocity[i] == 0 || log.time[i] < begin || log.time[i] >= end) continue;
    const Eigen::Vector2d row(std::abs(log.velocity[i]), 1);
    normal += row * row.transpose();
    right += row * log.torque[i] * Sign(log.velocity[i]);
  }
  if (normal.determinant() <= 0) {
    Refuse({"compensator"}, "has no two speeds of the day before from {:g} to {:g} s", begin, end);
  }
  const Eigen::Vector2d line = normal.ldlt().solve(right);
  return {line[0], line[1]};
}

double NoiseOf(const LogSamples& log) { return WhiteNoise(log.torque, log.velocity.array() != 0); }

Eigen::VectorXd StepsOf(const LogSamples& log) {
  Eigen::VectorXd steps = Eigen::VectorXd::Zero(log.size());
  for (Eigen::Index i = 1; i < log.size(); ++i) {
    steps[i] = std::max(0.0, log.time[i] - log.time[i - 1]);
  }
  return steps;
}

}  // namespace warmjoint
