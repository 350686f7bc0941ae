// A linear map of the rows of a least-squares problem.
#pragma once

#include <Eigen/Core>

namespace warmjoint {

/// What a fit does to its rows before it squares them: the same linear map for each column of the
/// Jacobian and for the residual, over the kept samples in their order.
class RowTransform {
 public:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  virtual ~RowTransform() = default;

  /// rows: [n x q], replaced by what the map makes of them.
  virtual void Apply(Rows& rows) const = 0;
  /// n
  virtual Eigen::Index size() const = 0;

  Eigen::MatrixXd Of(const Eigen::MatrixXd& rows) const {
    Rows mapped = rows;
    Apply(mapped);
    return mapped;
  }
};

}  // namespace warmjoint
