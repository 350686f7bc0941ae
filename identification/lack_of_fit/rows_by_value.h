// Rows of a matrix from one number each: functions of numbers that repeat, cosines and sines of angles.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <unordered_map>
#include <vector>

namespace warmjoint {

/// Rows that depend on one number each, computed once for equal numbers. x: [m]; rows(values) makes [n x c] of [n] values;
/// returns [m x c].
template <typename Rows>
Eigen::MatrixXd RowsByValue(const Eigen::VectorXd& x, Rows&& rows) {
  std::vector<double> values;
  std::vector<std::size_t> place(static_cast<std::size_t>(x.size()));
  std::unordered_map<double, std::size_t> places;
  std::size_t next = 0;
  for (std::size_t i = 0; i < place.size(); ++i) {
    const double value = x[static_cast<Eigen::Index>(i)];
    // numbers that repeat mostly do so in the same order
    if (next >= values.size() || values[next] != value) {
      const auto [at, is_new] = places.try_emplace(value, values.size());
      if (is_new) values.push_back(value);
      next = at->second;
    }
    place[i] = next++;
  }
  const Eigen::MatrixXd table = rows(Eigen::ArrayXd(
      Eigen::Map<const Eigen::ArrayXd>(values.data(), static_cast<Eigen::Index>(values.size()))));
  Eigen::MatrixXd all(x.size(), table.cols());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    all.row(i) = table.row(static_cast<Eigen::Index>(place[static_cast<std::size_t>(i)]));
  }
  return all;
}

/// cos and sin of angles. [m x 2]
inline Eigen::MatrixXd Waves(const Eigen::ArrayXd& angles) {
  Eigen::MatrixXd waves(angles.size(), 2);
  for (Eigen::Index i = 0; i < angles.size(); ++i) {
    // of one number, so that both come out of one call
    const double angle = angles[i];
    waves(i, 0) = std::cos(angle);
    waves(i, 1) = std::sin(angle);
  }
  return waves;
}

}  // namespace warmjoint
