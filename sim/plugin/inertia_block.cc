#include "sim/plugin/inertia_block.h"

#include <array>
#include <utility>

namespace warmjoint {
namespace {

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

}  // namespace

InertiaBlock::InertiaBlock(const mjModel* m, int tree)
    : first_(m->tree_dofadr[tree]), address_(m->M_rowadr[first_]) {
  // the tree's rows of M, which end with their diagonal elements
  for (int dof = first_; dof < first_ + m->tree_dofnum[tree]; ++dof) {
    row_.push_back(m->M_rowadr[dof] - address_);
    others_.push_back(m->M_rownnz[dof] - 1);
    for (int j = 0; j < m->M_rownnz[dof]; ++j) {
      column_.push_back(m->M_colind[m->M_rowadr[dof] + j] - first_);
    }
  }
  length_ = others_;
  taken_ = column_;
  value_.resize(column_.size());
  inverse_.assign(others_.size(), 0);
  chain_ = FindChain();
}

/// Null where the tree branches, or is a long one.
const InertiaBlock::Chain* InertiaBlock::FindChain() const {
  constexpr int longest = 8;
  static const auto chains = []<int... i>(std::integer_sequence<int, i...>) {
    return std::array{Chain{&ChainProducts<i + 1>::Multiply, &ChainProducts<i + 1>::Solve}...};
  }
  (std::make_integer_sequence<int, longest>());

  // then each row holds all those before it
  for (int k = 0; k < size(); ++k) {
    if (others_[k] != k) return nullptr;
  }
  return size() <= longest ? &chains[static_cast<size_t>(size() - 1)] : nullptr;
}

void InertiaBlock::MultiplyRows(const mjData* d, const Eigen::Array2d* x,
                                Eigen::Array2d* mx) const {
  // each element counts in its row and, mirrored, in its column
  const double* inertia = d->M + address_;
  const int* column = column_.data();
  const int rows = size();
  for (int k = 0; k < rows; ++k, ++inertia, ++column) {
    const Eigen::Array2d xk = x[k];
    Eigen::Array2d sum = Eigen::Array2d::Zero();
    for (int j = others_[k]; j > 0; --j, ++inertia, ++column) {
      const int i = *column;
      sum += *inertia * x[i];
      mx[i] += *inertia * xk;
    }
    mx[k] = sum + *inertia * xk;
  }
}

void InertiaBlock::Subtract(const mjData* d, const double* x, double* y) const {
  // each element counts in its row and, mirrored, in its column
  const double* inertia = d->M + address_;
  const int* column = column_.data();
  for (int k = 0; k < size(); ++k, ++inertia, ++column) {
    const double xk = x[k];
    double sum = 0;
    for (int j = others_[k]; j > 0; --j, ++inertia, ++column) {
      sum += *inertia * x[*column];
      y[*column] -= *inertia * xk;
    }
    y[k] -= sum + *inertia * xk;
  }
}

/// The ancestors of an ancestor are the beginning of a row's own, so that no element is added, and
/// rows are indexed alike.
void InertiaBlock::Factorise(const mjData* d, const std::vector<char>& takes) {
  // rows and columns of those that take part
  const double* inertia = d->M + address_;
  for (int k = 0; k < size(); ++k) {
    int length = 0;
    const int row = row_[k];
    for (int j = row; takes[k] && j < row + others_[k]; ++j) {
      if (!takes[column_[j]]) continue;
      taken_[row + length] = column_[j];
      value_[row + length++] = inertia[j];
    }
    length_[k] = length;
    inverse_[k] = takes[k] ? inertia[row + others_[k]] : 0;
  }

  // L^T D L from the last row on, in place
  for (int k = size() - 1; k >= 0; --k) {
    if (!takes[k]) continue;
    const double inverse = inverse_[k] = 1 / inverse_[k];
    double* const own = value_.data() + row_[k];
    const int* const column = taken_.data() + row_[k];
    for (int p = length_[k] - 1; p >= 0; --p) {
      const int i = column[p];
      const double element = own[p], factor = element * inverse;
      double* const above = value_.data() + row_[i];
      for (int q = 0; q < p; ++q) above[q] -= factor * own[q];
      inverse_[i] -= factor * element;
      own[p] = factor;
    }
  }
}

}  // namespace warmjoint
