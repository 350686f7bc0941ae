// Columns of the interface and of the rooms.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace warmjoint::api {

inline Eigen::VectorXd ToEigen(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

inline std::vector<double> FromEigen(const Eigen::VectorXd& values) {
  return {values.begin(), values.end()};
}

}  // namespace warmjoint::api
