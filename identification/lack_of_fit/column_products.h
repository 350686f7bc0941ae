// Products of columns with each other, over parts of their rows.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace warmjoint {

/// Products of each two of c columns, i <= j, over each part of the rows: [parts x c^2], in column i c + j; the others are
/// not set. columns: [m x c]; ends: one past the last row of each part, ascending.
Eigen::MatrixXd ProductsByPart(const Eigen::MatrixXd& columns,
                               const std::vector<Eigen::Index>& ends);

/// Products of each two columns over all rows. columns: [m x c]; returns [c x c].
Eigen::MatrixXd ProductsOf(const Eigen::MatrixXd& columns);

/// Products of some columns with others, over all rows. left: [m x a]; right: [m x b]; returns [a x b].
Eigen::MatrixXd ProductsBetween(const Eigen::MatrixXd& left, const Eigen::MatrixXd& right);

}  // namespace warmjoint
