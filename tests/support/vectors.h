// Vectors and matrices out of the golden numbers, and recordings made of them.
#pragma once

#include <warmjoint/recording.h>

#include <Eigen/Core>

#include "tests/support/shared_data.h"

namespace warmjoint::test {

/// [R x C] from a list of rows.
inline Eigen::MatrixXd ToMatrix(const nlohmann::json& rows) {
  Eigen::MatrixXd matrix(rows.size(), rows.at(0).size());
  for (size_t i = 0; i < rows.size(); ++i) matrix.row(i) = ToVector(rows[i]);
  return matrix;
}

/// A recording of a rotary joint, evenly sampled. step: s; velocity: [N] rad/s; torque: [N] N.m.
/// The position is the integral of the velocity, held for each step.
inline Measurements Record(double step, const Eigen::VectorXd& velocity,
                           const Eigen::VectorXd& torque) {
  Measurements m;
  m.time = Eigen::VectorXd::LinSpaced(velocity.size(), 0,
                                      step * static_cast<double>(velocity.size() - 1));
  m.velocity = velocity;
  m.torque = torque;
  m.position = Eigen::VectorXd::Zero(velocity.size());
  for (Eigen::Index i = 1; i < velocity.size(); ++i) {
    m.position[i] = m.position[i - 1] + step * velocity[i - 1];
  }
  return m;
}

/// The 240 noisy samples of the golden numbers (h = 15 s).
inline Measurements GoldenRecording() {
  const nlohmann::json& golden = Golden().at("dataset");
  return Record(golden.at("h"), ToVector(golden.at("v")), ToVector(golden.at("tau")));
}

}  // namespace warmjoint::test
