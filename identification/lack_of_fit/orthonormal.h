// Orthonormal bases of columns that may be linearly dependent.
#pragma once

#include <Eigen/Core>

namespace warmjoint {

/// An orthonormal basis of columns, and how it is made of them: basis = columns * r_inverse.
struct Basis {
  Eigen::MatrixXd basis;      // [m x r]
  Eigen::MatrixXd r_inverse;  // [q x r]
};

/// A QR decomposition with pivots by Gram's and Schmidt's method (Golub and Van Loan, Matrix Computations, 5.2.8), in which a
/// column of which little is left is made orthogonal once more to all before it as it joins. A column joins while its part
/// orthogonal to those before it is longer than `distinct`, the longest first; of those that are as long up to rounding the
/// first, so that rounding decides nothing. columns: [m x q] of norm 1 at most
Basis Orthonormal(Eigen::MatrixXd columns, double distinct);

}  // namespace warmjoint
