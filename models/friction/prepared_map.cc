#include "models/friction/prepared_map.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <numeric>

#include "models/friction/evaluate_map.h"

namespace warmjoint {
namespace {

using Numbers = Eigen::Map<const Eigen::VectorXd>;

/// sum / divisor, without the wait for a division where it changes nothing.
double Divided(double sum, double divisor) { return divisor == 1 ? sum : sum / divisor; }

}  // namespace

PreparedMap::PreparedMap(const FrictionMap& map) : factor_(map.factor) {
  // the axis with the most centres comes last
  const size_t dimensions = map.axes.size();
  std::vector<size_t> order(dimensions);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return map.axes[a].kernels.size() < map.axes[b].kernels.size();
  });
  for (const size_t a : order) {
    quantities_[axes_.size()] = map.axes[a].quantity;
    axes_.emplace_back(map.axes[a].kernels, map.kernels);
  }

  // the rows of the last axis's weights; none where one of the others has no centre
  const std::vector<int> last = axes_.back().Row();
  const size_t centres = map.axes[order.back()].kernels.size();
  std::vector<double> own;
  ForEachRow(map, order, [&](const auto& weight) {
    for (const int i : last) weights_.push_back(i < 0 ? 0 : weight(static_cast<size_t>(i)));
    for (size_t i = 0; i < centres; ++i) own.push_back(weight(i));
  });
  length_ = last.size();
  table_ = RowTable(map.axes[order.back()].kernels, map.kernels, own);
}

template <typename Visit>
void PreparedMap::ForEachRow(const FrictionMap& map, const std::vector<size_t>& order,
                             const Visit& visit) {
  const size_t dimensions = order.size();
  // strides of the map as it was given, whatever the order here
  const auto own_stride = [&](size_t a) {
    size_t stride = 1;
    for (size_t b = order[a] + 1; b < dimensions; ++b) stride *= map.axes[b].kernels.size();
    return stride;
  };

  // strides of the rows, over all axes but the last
  std::vector<std::vector<int>> outer;
  for (size_t a = 0; a + 1 < dimensions; ++a) outer.push_back(axes_[a].Row());
  strides_.assign(outer.size(), 1);
  for (size_t a = outer.size(); a-- > 1;) strides_[a - 1] = strides_[a] * outer[a].size();
  const size_t rows = outer.empty() ? 1 : strides_[0] * outer[0].size();

  for (size_t row = 0; row < rows; ++row) {
    size_t from = 0;
    bool present = true;
    for (size_t a = 0; a < outer.size(); ++a) {
      const int index = outer[a][row / strides_[a] % outer[a].size()];
      present = present && index >= 0;
      from += own_stride(a) * static_cast<size_t>(std::max(0, index));
    }
    const size_t stride = own_stride(dimensions - 1);
    visit([&](size_t i) { return present ? map.weights[from + i * stride] : 0.0; });
  }
}

/// The sum over all axes but the last two, of what `sums` tells from the kernels of the one before
/// the last and the first of its rows.
template <size_t axis, typename Sums>
double PreparedMap::Sum(const Active& active, size_t row, const Sums& sums) const {
  // from the first row of this axis that is active
  const ActiveKernels& kernels = active[axis];
  row += static_cast<size_t>(kernels.first) * strides_[axis];
  if (axis + 2 == axes_.size()) return sums(kernels, row);

  // each of its kernels weighs what the axes behind it come to
  double sum = 0;
  if constexpr (axis + 2 < kMostMapAxes) {
    const double* value = kernels.value.data() + kernels.begin;
    for (int i = 0; i < kernels.count; ++i, row += strides_[axis]) {
      sum += value[i] * Sum<axis + 1>(active, row, sums);
    }
  }
  return sum;
}

/// The sum of neighbouring rows of the table, four at a time.
EIGEN_ALWAYS_INLINE double PreparedMap::FromTable(const ActiveKernels& kernels, size_t row,
                                                  const RowTable::Spot& spot) const {
  const double* value = kernels.value.data() + kernels.begin;
  const size_t before = row % 4;
  size_t count = static_cast<size_t>(kernels.count);

  // from the beginning of a quad on
  std::array<double, kMostMapCentres + 8> shifted;
  if (before > 0) {
    Store(Four{}, shifted.data());
    std::copy_n(value, count + 3, shifted.data() + before);
    value = shifted.data();
    count += before;
  }
  // four rows at a time
  Four sum{};
  for (size_t i = 0; i < count; i += 4) {
    Four weights, rows;
    Load(value + i, weights);
    table_.Quad((row + i) / 4, spot, rows);
    sum += weights * rows;
  }
  return SumOf(sum);
}

WARMJOINT_FOR_EACH_PROCESSOR
double PreparedMap::Evaluate(const MapPoint<double>& point) const {
  Active active;
  double divisor = 1;
  const size_t last = axes_.size() - 1;
  // the kernels of one axis; false where none counts
  const auto prepare = [&](size_t a) {
    axes_[a].Kernels(point[static_cast<size_t>(quantities_[a])], active[a]);
    divisor *= active[a].sum;
    return active[a].count > 0;
  };
  for (size_t a = 0; a < last; ++a) {
    if (!prepare(a)) return 0;
  }

  const double factor = EvaluateFactor(factor_, point[static_cast<size_t>(MapQuantity::velocity)]);

  // the last axis by its table, where it has one here
  RowTable::Spot spot;
  if (table_.Locate(point[static_cast<size_t>(quantities_[last])], spot)) {
    const auto from_table = [&](const ActiveKernels& kernels, size_t row) {
      return FromTable(kernels, row, spot);
    };
    const double sum = last == 0 ? table_.Value(0, spot) : Sum<0>(active, 0, from_table);
    return Divided(factor * sum, divisor);
  }
  // else by its kernels
  if (!prepare(last)) return 0;
  const ActiveKernels& own = active[last];
  const Numbers value(own.value.data() + own.begin, own.count);
  const auto row_sum = [&](size_t row) {
    return value.dot(Numbers(weights_.data() + row * length_ + own.first, own.count));
  };
  const auto from_kernels = [&](const ActiveKernels& kernels, size_t row) {
    double sum = 0;
    for (int i = 0; i < kernels.count; ++i, ++row) {
      sum += kernels.value[static_cast<size_t>(kernels.begin + i)] * row_sum(row);
    }
    return sum;
  };
  const double sum = last == 0 ? row_sum(0) : Sum<0>(active, 0, from_kernels);
  return Divided(factor * sum, divisor);
}

WARMJOINT_FOR_EACH_PROCESSOR
bool PreparedMap::EvaluateTwo(const MapPoint<double>& point, double& value) const {
  RowTable::Spot spot;
  if (!table_.Locate(point[static_cast<size_t>(quantities_[1])], spot)) return false;
  const double factor = EvaluateFactor(factor_, point[static_cast<size_t>(MapQuantity::velocity)]);

  // kernels of the first axis that have no table there
  const double x = point[static_cast<size_t>(quantities_[0])];
  PreparedAxis::Tabled kernels;
  if (!axes_[0].FindTabled(x, kernels)) {
    ActiveKernels active;
    axes_[0].Kernels(x, active);
    const double sum = FromTable(active, static_cast<size_t>(active.first), spot);
    value = Divided(factor * sum, active.sum);
    return true;
  }

  // else each weighs the row at its place, four at a time
  Four sum{};
  for (int i = 0; i < kernels.count; i += 4) {
    Four weights, rows;
    kernels.table->Quad(static_cast<size_t>(i / 4), kernels.spot, weights);
    table_.Quad(static_cast<size_t>((kernels.first + i) / 4), spot, rows);
    sum += weights * rows;
  }
  value = factor * SumOf(sum);
  return true;
}

double PreparedMap::Value(const MapPoint<double>& point) const {
  double value = 0;
  if (axes_.size() == 2 && EvaluateTwo(point, value)) return value;
  return Evaluate(point);
}

}  // namespace warmjoint
