#include "identification/ridge/local_rows.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include "models/friction/prepared_map.h"

namespace warmjoint::inline identification {
namespace {

constexpr Eigen::Index kChunk = 16384;  // samples whose rows are held at once

/// The kernels of one axis that count: neighbours, on a circle across its end.
struct Window {
  std::uint16_t first = 0;
  std::uint16_t count = 0;
  auto operator<=>(const Window&) const = default;
};

/// Kernels of one axis, each at the place of its centre.
class AxisRow {
 public:
  AxisRow(const GaussianAxis& axis, KernelKind kind) : axis_(axis, kind), places_(axis_.Row()) {}

  /// The kernels that count at x, into phi [axis.size()]; others are not written.
  Window Fill(double x, double* phi) {
    axis_.Kernels(x, active_);
    const double* value = active_.value.data() + active_.begin;
    const int* place = places_.data() + active_.first;
    const auto counts = [&](int i) { return place[i] >= 0 && value[i] > 0; };
    int first = 0, last = active_.count;
    while (first < last && !counts(first)) ++first;
    while (first < last && !counts(last - 1)) --last;
    if (first == last) return {};
    for (int i = first; i < last; ++i) phi[place[i]] = value[i] / active_.sum;
    return {static_cast<std::uint16_t>(place[first]), static_cast<std::uint16_t>(last - first)};
  }

 private:
  PreparedAxis axis_;
  std::vector<int> places_;
  ActiveKernels active_{};
};

/// Kernels of every axis of every map at some samples, each axis by itself.
class AxisTable {
 public:
  AxisTable(const std::vector<FrictionMap>& maps, const MapPoints& points, Eigen::Index first,
            Eigen::Index last)
      : maps_(maps), first_(first) {
    for (const FrictionMap& map : maps) {
      for (const MapAxis& axis : map.axes) {
        rows_.emplace_back(axis.kernels, map.kernels);
        width_ += static_cast<Eigen::Index>(axis.kernels.size());
      }
      axes_ += static_cast<Eigen::Index>(map.axes.size());
    }
    phi_.resize(last - first, width_);
    factors_.resize(last - first, static_cast<Eigen::Index>(maps.size()));
    windows_.resize(static_cast<size_t>((last - first) * axes_));
    for (Eigen::Index i = first; i < last; ++i) Fill(points, i);
  }

  /// Order of the samples in which those with the same windows are neighbours.
  std::vector<Eigen::Index> Sorted() const {
    std::vector<Eigen::Index> order(static_cast<size_t>(phi_.rows()));
    std::iota(order.begin(), order.end(), first_);
    std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
      return std::lexicographical_compare(WindowsOf(a), WindowsOf(a) + axes_, WindowsOf(b),
                                          WindowsOf(b) + axes_);
    });
    return order;
  }

  bool SameWindows(Eigen::Index a, Eigen::Index b) const {
    return std::equal(WindowsOf(a), WindowsOf(a) + axes_, WindowsOf(b));
  }

  /// Indices of the kernels in the windows of a sample.
  std::vector<Eigen::Index> Kernels(Eigen::Index sample) const {
    std::vector<Eigen::Index> kernels;
    const Window* windows = WindowsOf(sample);
    Eigen::Index offset = 0;
    for (const FrictionMap& map : maps_) {
      std::vector<Eigen::Index> products{0};
      for (const MapAxis& axis : map.axes) {
        const auto size = static_cast<Eigen::Index>(axis.kernels.size());
        std::vector<Eigen::Index> next;
        for (const Eigen::Index before : products) {
          for (int k = 0; k < windows->count; ++k) {
            next.push_back(before * size + (windows->first + k) % size);
          }
        }
        products = std::move(next);
        ++windows;
      }
      for (const Eigen::Index product : products) kernels.push_back(offset + product);
      offset += static_cast<Eigen::Index>(map.size());
    }
    return kernels;
  }

  /// Their values at that sample, in the same order.
  void Values(Eigen::Index sample, double* row) const {
    const Window* windows = WindowsOf(sample);
    const double* phi = phi_.row(sample - first_).data();
    Eigen::Index m = 0;
    for (const FrictionMap& map : maps_) {
      // one empty window leaves no product
      const auto axes = static_cast<Eigen::Index>(map.axes.size());
      const bool any = std::all_of(windows, windows + axes,
                                   [](const Window& window) { return window.count > 0; });
      const double factor = factors_(sample - first_, m++);
      Eigen::Index count = any ? 1 : 0;
      if (any) row[0] = factor;
      for (const MapAxis& axis : map.axes) {
        count = Multiply(phi, *windows++, axis.kernels.size(), row, count);
        phi += axis.kernels.size();
      }
      row += count;
    }
  }

 private:
  /// Multiplies `count` products in place by the kernels of one more axis; returns their number.
  static Eigen::Index Multiply(const double* phi, Window window, size_t size, double* row,
                               Eigen::Index count) {
    for (Eigen::Index before = count - 1; before >= 0; --before) {
      const double product = row[before];
      for (int k = window.count - 1; k >= 0; --k) {
        row[before * window.count + k] = product * phi[(window.first + k) % size];
      }
    }
    return count * window.count;
  }

  void Fill(const MapPoints& points, Eigen::Index sample) {
    const Eigen::Index row = sample - first_;
    double* phi = phi_.row(row).data();
    Window* window = windows_.data() + row * axes_;
    auto axis_row = rows_.begin();
    const double v = points(sample, static_cast<int>(MapQuantity::velocity));
    for (size_t m = 0; m < maps_.size(); ++m) {
      factors_(row, static_cast<Eigen::Index>(m)) = EvaluateFactor(maps_[m].factor, v);
      for (const MapAxis& axis : maps_[m].axes) {
        *window++ = (axis_row++)->Fill(points(sample, static_cast<int>(axis.quantity)), phi);
        phi += axis.kernels.size();
      }
    }
  }

  const Window* WindowsOf(Eigen::Index sample) const {
    return windows_.data() + (sample - first_) * axes_;
  }

  const std::vector<FrictionMap>& maps_;
  Eigen::Index first_;
  std::vector<AxisRow> rows_;    // of all axes
  Eigen::Index width_ = 0;       // kernels of all axes
  Eigen::Index axes_ = 0;        // of all maps
  RowGroup::Rows phi_;           // [samples x width]
  RowGroup::Rows factors_;       // [samples x maps]
  std::vector<Window> windows_;  // [samples x axes]
};

}  // namespace

Eigen::Index KernelCount(const std::vector<FrictionMap>& maps) {
  Eigen::Index count = 0;
  for (const FrictionMap& map : maps) count += static_cast<Eigen::Index>(map.size());
  return count;
}

std::vector<RowGroup> GroupRows(const std::vector<FrictionMap>& maps, const MapPoints& points,
                                Eigen::Index first, Eigen::Index last) {
  const AxisTable table(maps, points, first, last);
  const std::vector<Eigen::Index> order = table.Sorted();
  std::vector<RowGroup> groups;
  for (auto begin = order.begin(); begin != order.end();) {
    const auto end = std::find_if_not(begin, order.end(),
                                      [&](Eigen::Index i) { return table.SameWindows(*begin, i); });
    RowGroup group;
    group.samples.assign(begin, end);
    group.kernels = table.Kernels(*begin);
    group.values.resize(end - begin, static_cast<Eigen::Index>(group.kernels.size()));
    for (Eigen::Index i = 0; i < group.values.rows(); ++i) {
      table.Values(group.samples[i], group.values.row(i).data());
    }
    groups.push_back(std::move(group));
    begin = end;
  }
  return groups;
}

Eigen::MatrixXd DenseKernels(const std::vector<FrictionMap>& maps, const MapPoints& points,
                             Eigen::Index first, Eigen::Index last) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(last - first, KernelCount(maps));
  for (const RowGroup& group : GroupRows(maps, points, first, last)) {
    for (size_t i = 0; i < group.samples.size(); ++i) {
      for (size_t k = 0; k < group.kernels.size(); ++k) {
        rows(group.samples[i] - first, group.kernels[k]) = group.values(i, k);
      }
    }
  }
  return rows;
}

void AddGroups(const std::vector<RowGroup>& groups, const Eigen::MatrixXd& free,
               const Eigen::VectorXd& y, NormalEquations& normal) {
  const Eigen::Index p = free.cols();
  for (const RowGroup& group : groups) {
    const auto m = static_cast<Eigen::Index>(group.kernels.size());
    const Eigen::MatrixXd columns = free(group.samples, Eigen::all);
    const Eigen::VectorXd torque = y(group.samples);
    Eigen::MatrixXd own = Eigen::MatrixXd::Zero(m, m);
    if (m > 0) own.selfadjointView<Eigen::Lower>().rankUpdate(group.values.transpose());
    const Eigen::MatrixXd across = group.values.transpose() * columns;
    const Eigen::VectorXd product = group.values.transpose() * torque;

    // into the lower half
    for (Eigen::Index j = 0; j < m; ++j) {
      const Eigen::Index column = p + group.kernels[j];
      for (Eigen::Index i = j; i < m; ++i) {
        const Eigen::Index row = p + group.kernels[i];
        normal.gram(std::max(row, column), std::min(row, column)) += own(i, j);
      }
      normal.gram.row(column).head(p) += across.row(j);
      normal.product[column] += product[j];
    }
    normal.gram.topLeftCorner(p, p) += columns.transpose() * columns;
    normal.product.head(p) += columns.transpose() * torque;
    normal.squares += torque.squaredNorm();
    normal.rows += torque.size();
  }
  normal.gram.triangularView<Eigen::StrictlyUpper>() = normal.gram.transpose();
}

NormalEquations LocalNormal(const std::vector<FrictionMap>& maps, const MapPoints& points,
                            const Eigen::MatrixXd& free, const Eigen::VectorXd& y,
                            Eigen::Index first, Eigen::Index last) {
  NormalEquations normal(free.cols() + KernelCount(maps));
  for (Eigen::Index begin = first; begin < last; begin += kChunk) {
    AddGroups(GroupRows(maps, points, begin, std::min(last, begin + kChunk)), free, y, normal);
  }
  return normal;
}

double LeaveOneOut(const std::vector<RowGroup>& groups, const Eigen::MatrixXd& free,
                   const Eigen::VectorXd& y, const NormalEquations& normal, double strength) {
  const Eigen::Index p = free.cols();
  const Eigen::Index d = normal.product.size();
  Eigen::MatrixXd gram = normal.gram;
  gram.diagonal().tail(d - p).array() += strength;
  const Eigen::LLT<Eigen::MatrixXd> factors(gram);
  if (factors.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
  const Eigen::MatrixXd inverse = factors.solve(Eigen::MatrixXd::Identity(d, d));
  const Eigen::VectorXd x = inverse * normal.product;

  // h_i = a_i (A^T A + s P)^-1 a_i^T
  double squares = 0;
  for (const RowGroup& group : groups) {
    std::vector<Eigen::Index> columns(static_cast<size_t>(p));
    std::iota(columns.begin(), columns.end(), 0);
    for (const Eigen::Index kernel : group.kernels) columns.push_back(p + kernel);
    Eigen::MatrixXd rows(group.values.rows(), static_cast<Eigen::Index>(columns.size()));
    rows << free(group.samples, Eigen::all), group.values;
    const Eigen::ArrayXd residual = y(group.samples) - rows * x(columns);
    const Eigen::ArrayXd leverage =
        (rows * inverse(columns, columns)).cwiseProduct(rows).rowwise().sum();
    squares += (residual / (1 - leverage)).square().sum();
  }
  return squares / static_cast<double>(normal.rows);
}

}  // namespace warmjoint::inline identification
