// Products with the inertia matrix of a robot without branches, and with its inverse.
#pragma once

#include <Eigen/Core>
#include <utility>

namespace warmjoint::inline sim {

/// Products for two vectors at once with a symmetric matrix of n rows, of which all elements up to
/// the diagonal are given, row after row, or with the inverse of one that is factorised as L'DL:
/// elements of L in place of those before the diagonal, inverse: 1/D. Everything is in registers.
template <int n>
struct ChainProducts {
  using Two = Eigen::Array2d;

  static void Multiply(const double* m, const Two* x, Two* mx) {
    Two in[n], out[n];
    ForEach<n>([&]<int k>() {
      in[k] = x[k];
      Two sum = m[At(k, k)] * in[k];
      ForEach<k>([&]<int j>() {
        sum += m[At(k, j)] * in[j];
        out[j] += m[At(k, j)] * in[k];
      });
      out[k] = sum;
    });
    ForEach<n>([&]<int k>() { mx[k] = out[k]; });
  }

  static void Solve(const double* factor, const double* inverse, Two* x) {
    Two in[n];
    ForEach<n>([&]<int k>() { in[k] = x[k]; });
    ForEach<n>([&]<int i>() {
      constexpr int k = n - 1 - i;
      ForEach<k>([&]<int j>() { in[j] -= factor[At(k, j)] * in[k]; });
    });
    ForEach<n>([&]<int k>() {
      in[k] *= inverse[k];
      ForEach<k>([&]<int j>() { in[k] -= factor[At(k, j)] * in[j]; });
      x[k] = in[k];
    });
  }

 private:
  static constexpr int At(int row, int column) { return row * (row + 1) / 2 + column; }

  /// do_one<0>(), ..., do_one<count - 1>()
  template <int count, typename DoOne>
  static void ForEach(const DoOne& do_one) {
    [&]<int... i>(std::integer_sequence<int, i...>) { (do_one.template operator()<i>(), ...); }
    (std::make_integer_sequence<int, count>());
  }
};

}  // namespace warmjoint::inline sim
