#include "models/friction/row_table.h"

#include <warmjoint/friction.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "models/friction/evaluate_map.h"

namespace warmjoint {
namespace {

constexpr double kBound = 3e-13;         // of the largest weight
constexpr size_t kMostNumbers = 131072;  // 1 MiB

/// All functions at x, [rows].
Eigen::VectorXd Functions(const GaussianAxis& axis, KernelKind kind,
                          const std::vector<double>& weights, double x) {
  std::array<double, kMostMapCentres> phi{};
  AxisKernels(axis, kind, x, phi.data());
  const auto n = static_cast<Eigen::Index>(axis.size());
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const Rows> w(weights.data(), static_cast<Eigen::Index>(weights.size()) / n, n);
  return w * Eigen::Map<const Eigen::VectorXd>(phi.data(), n);
}

/// Chebyshev's nodes, or the points between them and at the ends.
std::vector<double> Nodes(int count, double shift) {
  std::vector<double> nodes;
  for (int i = 0; i < count; ++i) {
    nodes.push_back(-std::cos(std::numbers::pi * (i + shift) / RowTable::kCoefficients));
  }
  return nodes;
}

}  // namespace

double SpacingOf(const GaussianAxis& axis, size_t begin, size_t end) {
  return (axis.centres[end - 1] - axis.centres[begin]) / static_cast<double>(end - 1 - begin);
}

bool IsEvenGrid(const GaussianAxis& axis, size_t begin, size_t end) {
  if (end - begin < 2) return false;
  const double spacing = SpacingOf(axis, begin, end);
  const auto near = [&](double a, double b) {
    const double size = std::max(std::abs(a), std::abs(b));
    constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
    return std::abs(a - b) <= 1e-13 * spacing + rounding * size;
  };
  for (size_t i = begin; i < end; ++i) {
    const double even = axis.centres[begin] + static_cast<double>(i - begin) * spacing;
    if (!near(axis.centres[i], even)) return false;
  }
  return !axis.period || near(static_cast<double>(end - begin) * spacing, *axis.period);
}

RowTable::RowTable(const GaussianAxis& axis, KernelKind kind, const std::vector<double>& weights) {
  if (axis.sides == Sides::apart || !IsEvenGrid(axis, 0, axis.size())) return;
  // the largest cells that keep to the bound, if any do
  double largest = 0;
  for (const double weight : weights) largest = std::max(largest, std::abs(weight));
  for (const size_t per_spacing : {2, 4, 8}) {
    if (weights.size() * per_spacing * kCoefficients > kMostNumbers) break;
    if (Fit(axis, kind, weights, per_spacing) <= kBound * largest) return;
  }
  *this = RowTable();
}

double RowTable::Fit(const GaussianAxis& axis, KernelKind kind, const std::vector<double>& weights,
                     size_t per_spacing) {
  const size_t n = axis.size(), rows = weights.size() / n;
  const double spacing = SpacingOf(axis, 0, n);
  const double size = spacing / static_cast<double>(per_spacing);
  period_ = axis.period.value_or(0);
  // cells over the grid and half a spacing beyond; those of a circle begin at its first centre
  per_cell_ = 1 / size;
  begin_ = axis.centres.front() - (axis.period ? 0 : spacing / 2);
  cells_ = n * per_spacing;
  end_ = static_cast<double>(cells_);
  coefficients_.assign((rows + 3) / 4 * cells_, {});

  const std::vector<double> nodes = Nodes(kCoefficients, 0.5);
  const std::vector<double> between = Nodes(kCoefficients + 1, 0);
  // polynomials through the nodes, whose powers are factored once
  Eigen::Matrix<double, kCoefficients, kCoefficients> powers;
  for (int i = 0; i < kCoefficients; ++i) {
    for (int k = 0; k < kCoefficients; ++k) powers(i, k) = std::pow(nodes[i], k);
  }
  const auto solver = powers.partialPivLu();

  // the coefficients of each cell, and how far off they are between the nodes
  double error = 0;
  for (size_t cell = 0; cell < cells_; ++cell) {
    const double middle = begin_ + (static_cast<double>(cell) + 0.5) * size;
    Eigen::MatrixXd values(kCoefficients, rows);
    for (int i = 0; i < kCoefficients; ++i) {
      values.row(i) = Functions(axis, kind, weights, middle + nodes[i] * size / 2);
    }
    const Eigen::MatrixXd solved = solver.solve(values);
    for (size_t row = 0; row < rows; ++row) {
      Polynomials& own = coefficients_[row / 4 * cells_ + cell];
      for (int k = 0; k < kCoefficients; ++k) {
        own[4 * static_cast<size_t>(k) + row % 4] = solved(k, static_cast<Eigen::Index>(row));
      }
    }
    // against the kernels themselves
    for (const double local : between) {
      const Eigen::VectorXd exact = Functions(axis, kind, weights, middle + local * size / 2);
      for (size_t row = 0; row < rows; ++row) {
        const double difference = Value(row, {cell, local}) - exact[static_cast<Eigen::Index>(row)];
        error = std::max(error, std::abs(difference));
      }
    }
  }
  return error;
}

/// Rounding may put the end of a circle beyond its last cell.
bool RowTable::LocateEnd(double place, Spot& spot) const {
  if (period_ == 0 || std::isnan(place)) return false;
  spot = {cells_ - 1, 1};
  return true;
}

}  // namespace warmjoint
