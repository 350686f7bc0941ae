// Orthonormal bases of columns that may be alike.
#pragma once

#include <Eigen/Core>

namespace warmjoint {

/// An orthonormal basis of columns, how it is made of them, basis = columns * mix, and they of it, columns = basis * held
/// but for what is too short to join.
struct Basis {
  Eigen::MatrixXd basis;  // [m x r]
  Eigen::MatrixXd mix;    // [q x r]
  Eigen::MatrixXd held;   // [r x q]
};

/// A column joins while what it has beside those before it is longer than `distinct`, the longest first. From the
/// products of the columns by Cholesky's method with pivots (Golub and Van Loan, Matrix Computations, 4.2.8), orthonormal
/// to 1e-10; where columns are so alike that products lose that, by Gram's and Schmidt's (5.2.8), which takes each off twice. Of
/// columns that are as long up to rounding the first joins.
/// columns: [m x q] of norm 1 at most.
Basis Orthonormal(const Eigen::MatrixXd& columns, double distinct);

/// The mix alone, [q x r]. products: [q x q] of the columns with each other; distinct: 0.001 or more.
Eigen::MatrixXd MixOfDistinct(const Eigen::MatrixXd& products, double distinct);

}  // namespace warmjoint
