// Fewer points for the same picture.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace warmjoint::report {

/// The part of an axis that a plot shows and how many rows or columns of pixels it has.
struct PixelSpan {
  double lower = 0;
  double upper = 1;
  int count = 1;
};

/// Which points draw the same curve: of each column of pixels the first, lowest, highest and last
/// in the order they came, so that no extreme is lost, and gaps (NaN). All of them where there are
/// less than 4 a column or x runs backwards (a curve that is no function of x).
/// x, y: [N]; returns indices, increasing.
std::vector<Eigen::Index> ReduceCurve(const Eigen::VectorXd& x, const Eigen::VectorXd& y,
                                      const PixelSpan& columns);

/// Which markers draw the same cloud: one for each pixel that has any. Where a pixel and all eight
/// about it have one, those of every other row and column cover the others, if a marker's radius
/// is more than a pixel. x, y: [N]; radius: pixels; returns indices, increasing.
std::vector<Eigen::Index> ReduceScatter(const Eigen::VectorXd& x, const Eigen::VectorXd& y,
                                        const PixelSpan& columns, const PixelSpan& rows,
                                        double radius);

}  // namespace warmjoint::report
