// Fewer points for the same picture.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace warmjoint::figures {

/// The part of an axis that a plot shows, and into how many cells it is cut.
struct CellSpan {
  double lower = 0;
  double upper = 1;
  int count = 1;
};

/// Which points draw the same curve: of each column the first, lowest, highest and last in the order
/// they came, so that no extreme is lost, and gaps (NaN): of several in a column the one over which y jumps farthest. All of them where there are less than 4 a
/// column or x runs backwards (a curve that is no function of x).
/// x, y: [N]; returns indices, increasing.
std::vector<Eigen::Index> ReduceCurve(const Eigen::VectorXd& x, const Eigen::VectorXd& y,
                                      const CellSpan& columns);

/// One sample of each cell that has any, the first: the same cloud where markers cover a cell. Samples beyond the
/// spans are left out. x, y: [N]; returns indices, increasing.
std::vector<Eigen::Index> ReduceCloud(const Eigen::VectorXd& x, const Eigen::VectorXd& y,
                                      const CellSpan& columns, const CellSpan& rows);

}  // namespace warmjoint::figures
