#include "identification/lack_of_fit/power_spectra.h"

#include <cassert>
#include <unsupported/Eigen/FFT>

namespace warmjoint {

using Eigen::Index;
using Eigen::MatrixXd;

MatrixXd PowerSpectra(const MatrixXd& columns, Index length, Index last) {
  assert(columns.rows() <= length && last < length);
  // both sequences in one transform, as real and as imaginary parts
  Eigen::VectorXcd numbers = Eigen::VectorXcd::Zero(length), spectrum;
  numbers.real().head(columns.rows()) = columns.col(0);
  numbers.imag().head(columns.rows()) = columns.col(1);
  // one transform a thread, which keeps its tables
  static thread_local Eigen::FFT<double> transform;
  // one number is its own transform, which Eigen's is not made for
  if (length == 1) {
    spectrum = numbers;
  } else {
    transform.fwd(spectrum, numbers);
  }

  // the transform at k and at -k together tells the sequences apart
  MatrixXd squares(last + 1, 2);
  for (Index k = 0; k <= last; ++k) {
    const Index mirrored = (length - k) % length;
    const double re = spectrum[k].real(), im = spectrum[k].imag();
    const double other_re = spectrum[mirrored].real(), other_im = spectrum[mirrored].imag();
    const auto square = [](double a, double b) { return 0.25 * (a * a + b * b); };
    squares(k, 0) = square(re + other_re, im - other_im);
    squares(k, 1) = square(re - other_re, im + other_im);
  }
  return squares;
}

}  // namespace warmjoint
