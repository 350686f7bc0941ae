#include "identification/maps/local_rows.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

#include "identification/model/normal_equations.h"
#include "models/friction/evaluate_map.h"
#include "models/friction/prepared_map.h"

namespace warmjoint {
namespace {

/// The kernels of one axis that are not negligible: a run of neighbours, on a circle possibly across its end.
struct Window {
  std::uint16_t first = 0;
  std::uint16_t count = 0;
  auto operator<=>(const Window&) const = default;
};

/// Kernels of one axis, each at the place of its centre.
class AxisRow {
 public:
  AxisRow(const GaussianAxis& axis, KernelKind kind) : axis_(axis, kind), places_(axis_.Row()) {}

  /// Writes the kernels that are not negligible at x into phi [axis.size()]; others are not written.
  Window Fill(double x, double* phi) {
    axis_.Kernels(x, active_);
    const double* value = active_.value.data() + active_.begin;
    const int* place = places_.data() + active_.first;
    const auto counts = [&](int i) { return place[i] >= 0 && value[i] > 0; };
    // the window leaves out kernels at its ends that are 0 or absent
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

  /// Appends the indices of the kernels in the windows of a sample.
  void AppendKernels(Eigen::Index sample, std::vector<Eigen::Index>& kernels) const {
    const Window* window = WindowsOf(sample);
    Eigen::Index offset = 0;
    for (const FrictionMap& map : maps_) {
      const size_t begin = kernels.size();
      kernels.push_back(0);
      for (const MapAxis& axis : map.axes) {
        // each product so far times each kernel in the window of one more axis
        const size_t before = kernels.size() - begin, size = axis.kernels.size();
        const size_t count = window->count;
        kernels.resize(begin + before * count);
        // from the back, so that none is overwritten before it is used
        for (size_t i = before; i-- > 0;) {
          const Eigen::Index base = kernels[begin + i] * static_cast<Eigen::Index>(size);
          for (size_t k = count; k-- > 0;) {
            kernels[begin + i * count + k] =
                base + static_cast<Eigen::Index>((window->first + k) % size);
          }
        }
        ++window;
      }
      for (size_t i = begin; i < kernels.size(); ++i) kernels[i] += offset;
      offset += static_cast<Eigen::Index>(map.size());
    }
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
    const Eigen::Index kernels = window.count;
    const auto to_end = std::min(kernels, static_cast<Eigen::Index>(size) - window.first);
    for (Eigen::Index before = count - 1; before >= 0; --before) {
      const double product = row[before];
      double* const products = row + before * kernels;
      // kernels after the circle's end come first: those at its begin may overwrite the product
      for (Eigen::Index k = kernels; k-- > to_end;) products[k] = product * phi[k - to_end];
      for (Eigen::Index k = to_end; k-- > 0;) products[k] = product * phi[window.first + k];
    }
    return count * kernels;
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

/// What it costs to add a group's products to those of all kernels, in samples; why 8: it changes the time only,
/// not the answer.
constexpr double kAdding = 8;

using Samples = std::vector<Eigen::Index>::const_iterator;

/// Makes groups of runs of samples with the same windows. Neighbouring runs join one group where they share most of their kernels.
class GroupMaker {
 public:
  GroupMaker(const AxisTable& table, Eigen::Index kernels)
      : table_(table), column_(static_cast<size_t>(kernels), kNone) {}

  /// The next run: samples from begin to before end.
  void Add(Samples begin, Samples end) {
    Run run{begin, end, {}};
    table_.AppendKernels(*begin, run.kernels);
    if (!runs_.empty() && !Suits(run)) Finish();
    for (const Eigen::Index kernel : run.kernels) {
      if (std::exchange(column_[kernel], kSome) == kNone) kernels_.push_back(kernel);
    }
    samples_ += end - begin;
    runs_.push_back(std::move(run));
  }

  std::vector<RowGroup> Groups() && {
    if (!runs_.empty()) Finish();
    return std::move(groups_);
  }

 private:
  static constexpr Eigen::Index kNone = -1, kSome = 0;

  struct Run {
    Samples begin, end;
    std::vector<Eigen::Index> kernels;  // in the order of AxisTable::Values
  };

  /// The cost of a group, whose products with each other are summed.
  static double Cost(Eigen::Index samples, size_t kernels) {
    const auto m = static_cast<double>(kernels);
    return (static_cast<double>(samples) + kAdding) * m * m;
  }

  /// Whether one group costs no more than two.
  bool Suits(const Run& run) const {
    const auto more = [&](Eigen::Index kernel) { return column_[kernel] == kNone; };
    const auto added = static_cast<size_t>(std::ranges::count_if(run.kernels, more));
    const Eigen::Index samples = run.end - run.begin;
    return Cost(samples_ + samples, kernels_.size() + added) <=
           Cost(samples_, kernels_.size()) + Cost(samples, run.kernels.size());
  }

  void Finish() {
    // kernels of the group in ascending order, and the column of each
    RowGroup& group = groups_.emplace_back();
    group.kernels = std::move(kernels_);
    std::ranges::sort(group.kernels);
    const auto count = static_cast<Eigen::Index>(group.kernels.size());
    for (Eigen::Index i = 0; i < count; ++i) column_[group.kernels[i]] = i;

    // values of all samples of its runs
    group.values.setZero(samples_, count);
    std::vector<double> values(group.kernels.size());
    double* row = group.values.data();
    for (const Run& run : runs_) {
      for (auto sample = run.begin; sample != run.end; ++sample, row += count) {
        group.samples.push_back(*sample);
        table_.Values(*sample, values.data());
        for (size_t i = 0; i < run.kernels.size(); ++i) row[column_[run.kernels[i]]] = values[i];
      }
    }
    // reset for the next group
    for (const Eigen::Index kernel : group.kernels) column_[kernel] = kNone;
    runs_.clear();
    kernels_.clear();
    samples_ = 0;
  }

  const AxisTable& table_;
  std::vector<RowGroup> groups_;

  // of the next group
  std::vector<Run> runs_;
  std::vector<Eigen::Index> kernels_;
  Eigen::Index samples_ = 0;
  std::vector<Eigen::Index> column_;  // of each kernel in the group
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
  GroupMaker maker(table, KernelCount(maps));
  // runs of samples in the same windows of all axes
  for (auto begin = order.begin(); begin != order.end();) {
    const auto end = std::find_if_not(begin, order.end(),
                                      [&](Eigen::Index i) { return table.SameWindows(*begin, i); });
    maker.Add(begin, end);
    begin = end;
  }
  return std::move(maker).Groups();
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

namespace {

constexpr Eigen::Index kChunk = 16384;         // samples whose rows are held at once
constexpr Eigen::Index kMostValues = 1 << 24;  // 128 MiB, if every kernel counted at every sample

/// Adds the rows [free columns, kernels] of the groups. free: [N x p]; y: [N]; both over the
/// points' rows. normal: of size p + kernels.
void AddGroups(const std::vector<RowGroup>& groups, const Eigen::MatrixXd& free,
               const Eigen::VectorXd& y, NormalEquations& normal) {
  const Eigen::Index p = free.cols();
  for (const RowGroup& group : groups) {
    const auto m = static_cast<Eigen::Index>(group.kernels.size());
    const Eigen::MatrixXd columns = free(group.samples, Eigen::all);
    const Eigen::VectorXd torque = y(group.samples);
    // samples of a group share their kernels, so that their products are one small dense block
    Eigen::MatrixXd own = Eigen::MatrixXd::Zero(m, m);
    if (m > 0) own.selfadjointView<Eigen::Lower>().rankUpdate(group.values.transpose());
    const Eigen::MatrixXd across = group.values.transpose() * columns;
    const Eigen::VectorXd product = group.values.transpose() * torque;

    // into the lower half
    for (Eigen::Index j = 0; j < m; ++j) {
      const Eigen::Index column = p + group.kernels[j];
      double* const below = normal.gram.col(column).data() + p;
      for (Eigen::Index i = j; i < m; ++i) below[group.kernels[i]] += own(i, j);
      normal.gram.row(column).head(p) += across.row(j);
      normal.product[column] += product[j];
    }
    // products of the free columns, and squares of the torque
    normal.gram.topLeftCorner(p, p) += columns.transpose() * columns;
    normal.product.head(p) += columns.transpose() * torque;
    normal.squares += torque.squaredNorm();
    normal.rows += torque.size();
  }
  normal.gram.triangularView<Eigen::StrictlyUpper>() = normal.gram.transpose();
}

/// Adds the products of the groups' rows with each y. y: [N x k] over the points' rows; products: [kernels x k]
void AddProducts(const std::vector<RowGroup>& groups, const Eigen::Ref<const Eigen::MatrixXd>& y,
                 Eigen::MatrixXd& products) {
  const bool one = y.cols() == 1;
  for (const RowGroup& group : groups) {
    if (one) {
      products.col(0)(group.kernels) += group.values.transpose() * y.col(0)(group.samples);
    } else {
      products(group.kernels, Eigen::all) +=
          group.values.transpose() * y(group.samples, Eigen::all);
    }
  }
}

}  // namespace

NormalEquations LocalNormal(const std::vector<FrictionMap>& maps, const MapPoints& points,
                            const Eigen::MatrixXd& free, const Eigen::VectorXd& y,
                            Eigen::Index first, Eigen::Index last) {
  NormalEquations normal(free.cols() + KernelCount(maps));
  for (Eigen::Index begin = first; begin < last; begin += kChunk) {
    AddGroups(GroupRows(maps, points, begin, std::min(last, begin + kChunk)), free, y, normal);
  }
  return normal;
}

Eigen::MatrixXd LocalProducts(const std::vector<FrictionMap>& maps, const MapPoints& points,
                              const Eigen::Ref<const Eigen::MatrixXd>& y) {
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(KernelCount(maps), y.cols());
  for (Eigen::Index begin = 0; begin < y.rows(); begin += kChunk) {
    AddProducts(GroupRows(maps, points, begin, std::min(y.rows(), begin + kChunk)), y, products);
  }
  return products;
}

double LeaveOneOut(const std::vector<RowGroup>& groups, const Eigen::MatrixXd& free,
                   const Eigen::VectorXd& y, const NormalEquations& normal, double strength) {
  const Eigen::Index p = free.cols();
  const Eigen::Index d = normal.product.size();
  // fit to all samples
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
    // without its own sample a residual is r / (1 - h)
    const Eigen::ArrayXd residual = y(group.samples) - rows * x(columns);
    const Eigen::ArrayXd leverage =
        (rows * inverse(columns, columns)).cwiseProduct(rows).rowwise().sum();
    squares += (residual / (1 - leverage)).square().sum();
  }
  return squares / static_cast<double>(normal.rows);
}

KernelRows::KernelRows(const std::vector<FrictionMap>& maps, const MapPoints& points,
                       Eigen::Index spans)
    : samples_(points.rows()), kernels_(KernelCount(maps)) {
  for (Eigen::Index i = 0; i < spans; ++i) {
    groups_.push_back(GroupRows(maps, points, i * samples_ / spans, (i + 1) * samples_ / spans));
  }
}

std::shared_ptr<const KernelRows> KernelRows::Kept(const std::vector<FrictionMap>& maps,
                                                   const MapPoints& points, Eigen::Index spans) {
  if (points.rows() * KernelCount(maps) > kMostValues) return nullptr;
  return std::make_shared<const KernelRows>(maps, points, spans);
}

NormalEquations KernelRows::Normal(Eigen::Index span, const Eigen::MatrixXd& free,
                                   const Eigen::VectorXd& y) const {
  NormalEquations normal(free.cols() + kernels_);
  AddGroups(groups_[static_cast<size_t>(span)], free, y, normal);
  return normal;
}

NormalEquations KernelRows::Normal(const Eigen::MatrixXd& free, const Eigen::VectorXd& y) const {
  NormalEquations normal(free.cols() + kernels_);
  for (const std::vector<RowGroup>& span : groups_) AddGroups(span, free, y, normal);
  return normal;
}

Eigen::MatrixXd KernelRows::Products(const Eigen::Ref<const Eigen::MatrixXd>& y) const {
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(kernels_, y.cols());
  for (const std::vector<RowGroup>& span : groups_) AddProducts(span, y, products);
  return products;
}

Eigen::VectorXd KernelRows::Times(const Eigen::VectorXd& weights) const {
  Eigen::VectorXd values(samples_);
  for (const std::vector<RowGroup>& span : groups_) {
    for (const RowGroup& group : span) {
      values(group.samples) = group.values * weights(group.kernels);
    }
  }
  return values;
}

}  // namespace warmjoint
