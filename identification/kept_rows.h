// The rows of samples that a selection keeps.
#pragma once

#include <warmjoint/prepared_log.h>

#include <Eigen/Core>

namespace warmjoint {

/// Rows that all take part.
inline Selection AllOf(Eigen::Index rows) {
  return {Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(rows, true), {}};
}

/// The rows of `given` that the selection keeps. given: [N] or [N x d], an expression is evaluated once; returns
/// [n] or [n x d].
template <typename Columns>
typename Columns::PlainObject Kept(const Eigen::MatrixBase<Columns>& given,
                                   const Selection& selection) {
  const auto& all = given.eval();
  const Eigen::Index count = selection.count();
  if (count == all.rows()) return all;

  typename Columns::PlainObject kept(count, all.cols());
  for (Eigen::Index column = 0; column < all.cols(); ++column) {
    Eigen::Index row = 0;
    for (Eigen::Index i = 0; i < all.rows(); ++i) {
      if (selection.keep[i]) kept(row++, column) = all(i, column);
    }
  }
  return kept;
}

/// The values of the kept samples at their places among all, and `elsewhere` at the others. kept: [n]; returns [N]
inline Eigen::VectorXd AmongAll(const Eigen::VectorXd& kept, const Selection& selection,
                                double elsewhere) {
  Eigen::VectorXd all = Eigen::VectorXd::Constant(selection.keep.size(), elsewhere);
  for (Eigen::Index i = 0, n = 0; i < all.size(); ++i) {
    if (selection.keep[i]) all[i] = kept[n++];
  }
  return all;
}

}  // namespace warmjoint
