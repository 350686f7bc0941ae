// The inertia matrix of one kinematic tree, and factors of its blocks.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <vector>

namespace warmjoint {

/// The rows of the inertia matrix M that belong to one kinematic tree, as MuJoCo holds them: of each
/// degree of freedom the elements of those before it on its way to the root, then its own.
class InertiaBlock {
 public:
  InertiaBlock() = default;
  /// tree: its number in the model.
  InertiaBlock(const mjModel* m, int tree);

  int first() const { return first_; }
  int size() const { return static_cast<int>(others_.size()); }

  /// M x, of two vectors at once. Both: [size].
  void Multiply(const mjData* d, const Eigen::Array2d* x, Eigen::Array2d* mx) const {
    chain_ ? chain_->multiply(d->M + address_, x, mx) : MultiplyRows(d, x, mx);
  }

  /// Takes M x from y. x, y: [size].
  void Subtract(const mjData* d, const double* x, double* y) const;

  /// Replaces x by M^-1 x with the engine's own factors, of two vectors at once. x: [size].
  void Solve(const mjData* d, Eigen::Array2d* x) const {
    if (chain_) return chain_->solve(d->qLD + address_, d->qLDiagInv + first_, x);
    SolveBy(d->qLD + address_, d->qLDiagInv + first_, column_.data(), others_.data(), x);
  }

  /// M = L'DL of the degrees of freedom that `takes` names: [size], the others are left out.
  void Factorise(const mjData* d, const std::vector<char>& takes);

  /// Replaces x by the solution with the block of the last Factorise; what was left out stays 0. x:
  /// [size], 0 where left out.
  void SolveBlock(double* x) const {
    SolveBy(value_.data(), inverse_.data(), taken_.data(), length_.data(), x);
  }

 private:
  /// ChainProducts of a size.
  struct Chain {
    void (*multiply)(const double* m, const Eigen::Array2d* x, Eigen::Array2d* mx);
    void (*solve)(const double* factor, const double* inverse, Eigen::Array2d* x);
  };
  const Chain* FindChain() const;
  void MultiplyRows(const mjData* d, const Eigen::Array2d* x, Eigen::Array2d* mx) const;
  template <typename T>
  void SolveBy(const double* value, const double* inverse, const int* column, const int* length,
               T* x) const;

  int first_ = 0;                 // degree of freedom
  int address_ = 0;               // of its row in mjData.M
  std::vector<int> row_;          // [size] address of each row from there
  std::vector<int> others_;       // [size] elements of each row besides its diagonal
  std::vector<int> column_;       // counted from first
  const Chain* chain_ = nullptr;  // where nothing branches

  // factors: rows as above without what was left out
  std::vector<int> length_, taken_;
  std::vector<double> value_, inverse_;
};

template <typename T>
void InertiaBlock::SolveBy(const double* value, const double* inverse, const int* column,
                           const int* length, T* x) const {
  const int* const row = row_.data();
  const int count = size();
  for (int k = count - 1; k > 0; --k) {
    const T xk = x[k];
    for (int j = row[k], end = j + length[k]; j < end; ++j) x[column[j]] -= value[j] * xk;
  }
  for (int k = 0; k < count; ++k) {
    T xk = x[k] * inverse[k];
    for (int j = row[k], end = j + length[k]; j < end; ++j) xk -= value[j] * x[column[j]];
    x[k] = xk;
  }
}

}  // namespace warmjoint
