// Fourier's transform of two sequences at once.
#pragma once

#include <Eigen/Core>

namespace warmjoint {

/// |sum over n of x[n] exp(-2 pi i k n / length)|^2 of two real sequences, as the real and the imaginary part of one
/// transform. columns: [n x 2], n <= length: zeros follow; length: best a power of 2; returns [(last + 1) x 2] for
/// k = 0 to last < length.
Eigen::MatrixXd PowerSpectra(const Eigen::MatrixXd& columns, Eigen::Index length,
                             Eigen::Index last);

}  // namespace warmjoint
