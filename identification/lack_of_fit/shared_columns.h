// Candidate columns that rows share: steps, decays.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace warmjoint {

/// Many columns of few different rows: row i of column j is factor[i] * shares(place[i], j). Sums over rows are made
/// once for each place, whatever the number of columns.
struct SharedColumns {
  std::vector<Eigen::Index> place;  // [m] 0 <= place < n
  Eigen::VectorXd factor;           // [m]
  Eigen::MatrixXd shares;           // [n x c]

  /// One of them. [m]
  Eigen::VectorXd Column(Eigen::Index j) const {
    Eigen::VectorXd column(factor.size());
    for (Eigen::Index i = 0; i < column.size(); ++i) {
      column[i] = factor[i] * shares(place[static_cast<size_t>(i)], j);
    }
    return column;
  }

  /// Sums over the rows of each place. values: [m]; returns [n].
  template <typename Values>
  Eigen::VectorXd SumsOf(const Values& values) const {
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(shares.rows());
    for (Eigen::Index i = 0; i < factor.size(); ++i) {
      sums[place[static_cast<size_t>(i)]] += values[i];
    }
    return sums;
  }
};

}  // namespace warmjoint
