// The first step of every identifier: checks of the data, with a sentence on what they lack.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "identification/identifier.h"

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
Eigen::VectorXd AmongAll(const Eigen::VectorXd& kept, const Selection& selection, double elsewhere);

/// Why nothing can be fitted to these data: a number that is not finite, too few kept samples for
/// `parameters`, or a constant torque. Empty where the data can be used.
std::optional<std::string> Unusable(const IdentifierInput& input, int parameters);

/// Names of the columns that cannot be distinguished, and the motion that would distinguish them: one sentence.
/// mixed: names of law parameters.
std::string Indistinct(const std::vector<std::string>& mixed, const LogSamples& measurements,
                       const Selection& selection);

}  // namespace warmjoint
