// What law and maps share.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace warmjoint {

/// Columns of the law, or others without a prior, that the kernels can imitate, to a thousandth of their squares: the
/// prior alone tells these apart from a map. gram: [d x d] A^T A of `free` such columns and the kernels; ascending.
std::vector<Eigen::Index> ImitatedColumns(const Eigen::MatrixXd& gram, Eigen::Index free);

/// Those of them that have a bound, which is the law's mark. lower: [free] or empty: none.
std::vector<Eigen::Index> ImitatedLaw(const Eigen::MatrixXd& gram, Eigen::Index free,
                                      const std::vector<double>& lower);

}  // namespace warmjoint
