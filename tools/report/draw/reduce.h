// Fewer points for the same picture.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace warmjoint::report {

/// The part of an axis that a plot shows, and into how many cells it is cut.
struct CellSpan {
  double lower = 0;
  double upper = 1;
  int count = 1;
};

/// Which points draw the same curve: of each column the first, lowest, highest and last in the order
/// they came, so that no extreme is lost, and gaps (NaN). All of them where there are less than 4 a
/// column or x runs backwards (a curve that is no function of x).
/// x, y: [N]; returns indices, increasing.
std::vector<Eigen::Index> ReduceCurve(const Eigen::VectorXd& x, const Eigen::VectorXd& y,
                                      const CellSpan& columns);

/// Strokes of a pen as wide as a marker that draw the same cloud: each goes from the lowest
/// to the highest sample of a column, and breaks where none is for more than `reach` heights of a row.
/// A lone sample is a stroke to itself. x, y: [N]; returns begin and end, by column and row.
std::vector<std::pair<Eigen::Index, Eigen::Index>> ReduceCloud(const Eigen::VectorXd& x,
                                                               const Eigen::VectorXd& y,
                                                               const CellSpan& columns,
                                                               const CellSpan& rows, double reach);

}  // namespace warmjoint::report
