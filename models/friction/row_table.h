// Axes of even centres, and weighted sums of their kernels as piecewise polynomials, for maps that an engine evaluates.
#pragma once

#include <warmjoint/friction.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "models/foundation/four.h"

namespace warmjoint {

/// Spacing of the centres from `begin` to before `end`, which are two at least.
double SpacingOf(const GaussianAxis& axis, size_t begin, size_t end);

/// Whether two or more centres are even to 1e-13 of their spacing and their own rounding, and close
/// evenly where they lie on a circle.
bool IsEvenGrid(const GaussianAxis& axis, size_t begin, size_t end);

/// The functions sum_j kappa_j(x) w_(row, j), one for each row of weights, where they are smooth
/// and their centres even: polynomials of degree 9 in cells of a half, a quarter or an eighth of a
/// spacing, to 3e-13 of the largest weight, which is checked against the kernels themselves. Four rows
/// lie side by side, and are evaluated at once.
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
  bool Locate(double x, Spot& spot) const {
    double offset = x - begin_;
    if (period_ > 0 && (offset < 0 || offset >= period_)) {
      offset -= period_ * std::floor(offset / period_);
    }
    const double place = offset * per_cell_;
    if (!(place >= 0 && place < end_)) [[unlikely]]
      return LocateEnd(place, spot);
    const auto cell = static_cast<int>(place);
    spot = {static_cast<size_t>(cell), 2 * (place - cell) - 1};
    return true;
  }

  /// The functions of rows 4 quad to 4 quad + 3 there, in the unit of the weights; 0 of rows beyond the last.
  EIGEN_ALWAYS_INLINE void Quad(size_t quad, const Spot& spot, Four& value) const {
    const double* c = coefficients_[quad * cells_ + spot.cell].data();
    const double x = spot.local, y = x * x;
    Four even, odd, next;
    Load(c + 4 * 8, even);
    Load(c + 4 * 9, odd);
    for (int power = 6; power >= 0; power -= 2) {
      Load(c + 4 * power, next);
      even = next + y * even;
      Load(c + 4 * (power + 1), next);
      odd = next + y * odd;
    }
    value = even + x * odd;
  }

  /// The function of one row there.
  EIGEN_ALWAYS_INLINE double Value(size_t row, const Spot& spot) const {
    Four four;
    Quad(row / 4, spot, four);
    return four[row % 4];
  }

 private:
  /// Fills the table with so many cells to a spacing; returns the largest error over sampled
  /// points, in the unit of the weights.
  double Fit(const GaussianAxis& axis, KernelKind kind, const std::vector<double>& weights,
             size_t per_spacing);

  bool LocateEnd(double place, Spot& spot) const;

  /// The polynomials of four rows in one cell, [kCoefficients x 4], the constants first; in as few lines of a
  /// processor's cache as they need.
  struct alignas(64) Polynomials : std::array<double, 4 * kCoefficients> {};

  double begin_ = 0;     // of the first cell
  double per_cell_ = 0;  // 1 over a cell's size
  double period_ = 0;    // of a circle, else 0
  double end_ = 0;       // the number of cells
  size_t cells_ = 0;
  std::vector<Polynomials> coefficients_;  // [quads of rows x cells]
};

}  // namespace warmjoint
