#include "identification/lack_of_fit/power_spectra.h"

#include <bit>
#include <cassert>
#include <numbers>

#include "identification/lack_of_fit/wave_products.h"

namespace warmjoint::inline identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// A complex number in two registers.
struct Complex {
  double re, im;

  Complex operator+(const Complex& b) const { return {re + b.re, im + b.im}; }
  Complex operator-(const Complex& b) const { return {re - b.re, im - b.im}; }
  Complex operator*(const Complex& b) const {
    return {re * b.re - im * b.im, re * b.im + im * b.re};
  }
  /// times -i
  Complex Turned() const { return {im, -re}; }
};

/// One stage: `apart` interleaved transforms of n numbers become four times as many of n/4. Real parts stand apart from
/// imaginary ones, so that the inner loop runs in parallel. waves: [N x 2] cos and sin of 2 pi k / N, N = n * apart.
void Quarter(const MatrixXd& waves, Index n, Index apart, const double* __restrict from_re,
             const double* __restrict from_im, double* __restrict re, double* __restrict im) {
  const auto from = [=](Index i) -> Complex { return {from_re[i], from_im[i]}; };
  const Index step = apart * n / 4;
  for (Index p = 0; p < n / 4; ++p) {
    const auto wave = [&](Index k) -> Complex {
      return {waves(k * p * apart, 0), -waves(k * p * apart, 1)};
    };
    const Complex once = wave(1), twice = wave(2), thrice = wave(3);
    for (Index q = 0; q < apart; ++q) {
      const Index i = q + apart * p, o = q + apart * 4 * p;
      const Complex a = from(i), b = from(i + step);
      const Complex c = from(i + 2 * step), d = from(i + 3 * step);
      const Complex even = a + c, odd = a - c, sum = b + d, turned = (b - d).Turned();
      const Complex out[4] = {even + sum, once * (odd + turned), twice * (even - sum),
                              thrice * (odd - turned)};
      for (Index k = 0; k < 4; ++k) {
        re[o + k * apart] = out[k].re;
        im[o + k * apart] = out[k].im;
      }
    }
  }
}

/// The last stage of an odd power of 2: pairs.
void Halve(Index apart, const MatrixXd& from, MatrixXd& to) {
  to.topRows(apart) = from.topRows(apart) + from.bottomRows(apart);
  to.bottomRows(apart) = from.topRows(apart) - from.bottomRows(apart);
}

}  // namespace

MatrixXd PowerSpectra(const MatrixXd& columns, Index length, Index last) {
  assert(std::has_single_bit(static_cast<unsigned long>(length)) && columns.rows() <= length);
  assert(last < length);
  MatrixXd numbers = MatrixXd::Zero(length, 2), next(length, 2);
  numbers.topRows(columns.rows()) = columns;
  const MatrixXd waves = EvenWaves(0, 2 * std::numbers::pi / static_cast<double>(length), length);
  Index n = length, apart = 1;
  for (; n >= 4; n /= 4, apart *= 4) {
    Quarter(waves, n, apart, numbers.col(0).data(), numbers.col(1).data(), next.col(0).data(),
            next.col(1).data());
    numbers.swap(next);
  }
  if (n == 2) {
    Halve(apart, numbers, next);
    numbers.swap(next);
  }

  // the transform at k and at -k together tells the sequences apart
  MatrixXd squares(last + 1, 2);
  for (Index k = 0; k <= last; ++k) {
    const Index mirrored = (length - k) % length;
    const double re = numbers(k, 0), im = numbers(k, 1);
    const double other_re = numbers(mirrored, 0), other_im = numbers(mirrored, 1);
    const auto square = [](double a, double b) { return 0.25 * (a * a + b * b); };
    squares(k, 0) = square(re + other_re, im - other_im);
    squares(k, 1) = square(re - other_re, im + other_im);
  }
  return squares;
}

}  // namespace warmjoint::inline identification
