// Weighted sums of one axis's kernels as piecewise polynomials, for maps that an engine evaluates.
#pragma once

#include <cstddef>
#include <vector>

#include "models/friction/gaussian_axis.h"

namespace warmjoint::inline models {

/// The functions sum_j kappa_j(x) w_(row, j), one for each row of weights, where they are smooth
/// and their centres even: polynomials of degree 9 in cells of a half, a quarter or an eighth of a
/// spacing, to 3e-13 of the largest weight, which is checked against the kernels themselves.
class RowTable {
 public:
  static constexpr int kCoefficients = 10;

  /// Where x lies: its cell, and its place in that from -1 to 1.
  struct Spot {
    size_t cell = 0;
    double local = 0;
  };

  RowTable() = default;

  /// weights: [rows x axis.size()]. Empty where the axis is no even grid with its sides together,
  /// where the bound is not met, or where the table would take more than 1 MiB.
  RowTable(const GaussianAxis& axis, KernelKind kind, const std::vector<double>& weights);

  bool empty() const { return cells_ == 0; }

  /// False where x is more than half a spacing outside of the grid, or the table is empty.
  bool Locate(double x, Spot& spot) const;

  /// The function of a row there, in the unit of the weights.
  double Value(size_t row, const Spot& spot) const {
    const double* c = coefficients_.data() + (row * cells_ + spot.cell) * kCoefficients;
    const double x = spot.local, y = x * x;
    const double even = c[0] + y * (c[2] + y * (c[4] + y * (c[6] + y * c[8])));
    const double odd = c[1] + y * (c[3] + y * (c[5] + y * (c[7] + y * c[9])));
    return even + x * odd;
  }

 private:
  /// Fills the table with so many cells to a spacing; returns the largest error over sampled
  /// points, in the unit of the weights.
  double Fit(const GaussianAxis& axis, KernelKind kind, const std::vector<double>& weights,
             size_t per_spacing);

  double begin_ = 0;     // of the first cell
  double per_cell_ = 0;  // 1 over a cell's size
  double period_ = 0;    // of a circle, else 0
  size_t cells_ = 0;
  std::vector<double> coefficients_;  // [rows x cells x kCoefficients], the constant first
};

}  // namespace warmjoint::inline models
