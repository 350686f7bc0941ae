#include "models/friction/prepared_map.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "models/friction/evaluate_map.h"
#include "models/friction/row_table.h"

namespace warmjoint {
namespace {

using Numbers = Eigen::Map<const Eigen::VectorXd>;

/// sum / divisor, without the wait for a division where it changes nothing.
double Divided(double sum, double divisor) { return divisor == 1 ? sum : sum / divisor; }

/// exp(-x^2 / 2) is 3e-13 of its peak here.
constexpr double kReach = 7.6;  // widths

/// Axes of so many centres, and no more, have their kernels tabulated.
constexpr int kFew = 8;

/// All kernels of a short even segment beyond its ends, seen from the nearer one: one exponential, and none where
/// the nearest alone counts, or where none does. place: from the first centre, in spacings.
template <typename Segment>
void KernelsFromEnd(const Segment& segment, double place, bool normalised, ActiveKernels& active) {
  const int n = segment.size(), last = n - 1;
  const bool above = place > 0;
  // distance from the nearer end, in widths
  const double distance = (above ? place - last : -place) * segment.ratio;
  active.first = segment.row;
  active.count = n;
  active.begin = 0;
  active.sum = 1;
  // so far off that no kernel counts, or the nearest alone
  if (!normalised && distance > kReach) {
    active.count = 0;
    return;
  }
  if (normalised && distance * segment.ratio > kReach * kReach / 2) {
    std::fill_n(active.value.data(), n, 0.0);
    active.value[static_cast<size_t>(above ? last : 0)] = 1;
    return;
  }

  // each kernel by the one before it, from the nearer end on
  const double fall = std::exp(-distance * segment.ratio);
  double kernel = normalised ? 1.0 : std::exp(-distance * distance / 2), sum = 0;
  for (int i = 0; i < n; ++i, kernel *= fall) {
    const double value = kernel * segment.bell[static_cast<size_t>(i)];
    active.value[static_cast<size_t>(above ? last - i : i)] = value;
    sum += value;
  }
  if (normalised) active.sum = sum;
}

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

PreparedAxis::PreparedAxis(const GaussianAxis& axis, KernelKind kind)
    : sides_(axis.sides), kind_(kind), axis_(axis) {
  const int n = static_cast<int>(axis.size());

  // with the sides apart, each side is an axis by itself
  const auto zero = std::upper_bound(axis.centres.begin(), axis.centres.end(), 0.0);
  const int negative = static_cast<int>(zero - axis.centres.begin());
  if (axis.sides == Sides::apart) {
    segments_ = {MakeSegment(0, negative), MakeSegment(negative, n)};
  } else {
    segments_ = {MakeSegment(0, n)};
  }

  // places of the segments in the row; those of a table begin at a multiple of four
  int row = 0;
  for (Segment& segment : segments_) {
    segment.row = row + segment.pad;
    if (!segment.table.empty()) segment.row = (segment.row + 3) / 4 * 4;
    row = segment.row + segment.size() + segment.pad + 1;
  }
}

PreparedAxis::Segment PreparedAxis::MakeSegment(int begin, int end) const {
  Segment segment{.begin = begin, .end = end};
  const int n = segment.size();
  segment.table = TableOf(begin, end);
  const auto from = static_cast<size_t>(begin), to = static_cast<size_t>(end);
  if (!IsEvenGrid(axis_, from, to)) return segment;
  // the bell that all kernels of an even grid share, as far as it counts
  const double spacing = SpacingOf(axis_, from, to), ratio = spacing / axis_.width;
  segment.ratio = ratio;
  segment.per_spacing = 1 / spacing;
  for (int i = 0; i < n && (i - 0.5) * ratio < kReach; ++i) {
    segment.bell.push_back(std::exp(-i * ratio * i * ratio / 2));
  }
  // kernels that reach around a circle to themselves are not neighbours
  const int most = axis_.period ? n : static_cast<int>(kMostMapCentres);
  if (2 * segment.reach() + 1 > most) segment.bell.clear();
  const int reach = segment.reach();
  // as few as one centre reaches are all evaluated
  segment.pad = !axis_.period && n <= reach + 1 ? 0 : reach;
  for (int place = -reach; place <= n + reach; ++place) {
    segment.present.push_back(IndexAt(segment, place) >= 0);
  }
  return segment;
}

/// Tables of the kernels by themselves; empty where they are many or cannot be tabulated.
RowTable PreparedAxis::TableOf(int begin, int end) const {
  const int n = end - begin;
  if (n < 2 || n > kFew || axis_.period) return {};
  // the segment as an axis of its own, with a weight of 1 for one kernel in each row
  GaussianAxis own = axis_;
  own.centres.assign(axis_.centres.begin() + begin, axis_.centres.begin() + end);
  own.sides = Sides::together;
  std::vector<double> weights;
  for (int row = 0; row < n; ++row) {
    for (int i = 0; i < n; ++i) weights.push_back(row == i);
  }
  return RowTable(own, kind_, weights);
}

/// The centre at a place counted from the segment's first; -1 where there is none.
int PreparedAxis::IndexAt(const Segment& segment, int place) const {
  const int n = segment.size();
  if (axis_.period && !segment.bell.empty()) return segment.begin + (place + n) % n;
  return place >= 0 && place < n ? segment.begin + place : -1;
}

std::vector<int> PreparedAxis::Row() const {
  std::vector<int> row;
  for (const Segment& segment : segments_) {
    row.resize(static_cast<size_t>(segment.row - segment.pad), -1);
    for (int place = -segment.pad; place <= segment.size() + segment.pad; ++place) {
      row.push_back(IndexAt(segment, place));
    }
  }
  return row;
}

void PreparedAxis::UntabledKernels(const Segment& segment, double x, ActiveKernels& active) const {
  if (segment.bell.empty() || !EvenKernels(segment, x, active)) FreeKernels(segment, x, active);
  // they are read four at a time
  std::fill_n(active.value.data() + active.begin + active.count, 3, 0.0);
}

/// Kernels of an even grid, as many at every x, so that no branch depends on it; false, and
/// nothing done, more than half a spacing outside of a grid that is not short.
bool PreparedAxis::EvenKernels(const Segment& segment, double x, ActiveKernels& active) const {
  // how far along the grid, in spacings; a circle is gone around first
  double offset = x - axis_.centres[segment.begin];
  const bool circle = axis_.period.has_value();
  if (circle && (offset < 0 || offset >= *axis_.period)) {
    offset -= *axis_.period * std::floor(offset / *axis_.period);
  }
  const double place = offset * segment.per_spacing;
  const bool normalised = kind_ == KernelKind::normalised;
  const bool all = segment.pad < segment.reach();
  // outside of the grid, only a short one has kernels told from its end
  if (!(place >= -0.5 && place < segment.size() - 0.5 + circle)) {
    if (circle || !all) return false;
    KernelsFromEnd(segment, place, normalised, active);
    return true;
  }

  // the nearest centre, and the distance from it in widths
  const int centre = static_cast<int>(place + 0.5);
  const double distance = (place - centre) * segment.ratio;
  const int reach = segment.reach();
  active.first = all ? segment.row : segment.row + centre - reach;
  active.count = all ? segment.size() : 2 * reach + 1;
  active.begin = all ? reach - centre : 0;

  // its neighbours up and down; places without a centre meet weights of 0
  const double up = std::exp(distance * segment.ratio);
  const double down = 1 / up;
  const double* bell = segment.bell.data();
  const double* present = segment.present.data() + centre + reach;
  double* kernel = active.value.data() + reach;
  kernel[0] = normalised ? 1.0 : std::exp(-distance * distance / 2);
  double upward = kernel[0], downward = kernel[0], sum_above = kernel[0], sum_below = 0;
  for (int i = 1; i <= reach; ++i) {
    kernel[i] = (upward *= up) * bell[i];
    kernel[-i] = (downward *= down) * bell[i];
    sum_above += kernel[i] * present[i];
    sum_below += kernel[-i] * present[-i];
  }
  active.sum = normalised ? sum_above + sum_below : 1;
  return true;
}

void PreparedAxis::FreeKernels(const Segment& segment, double x, ActiveKernels& active) const {
  active.first = segment.row;
  active.count = segment.size();
  active.begin = 0;
  double* kernel = active.value.data();

  // distances in widths, squared; the nearest is what normalised kernels are seen from
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < active.count; ++i) {
    double distance = x - axis_.centres[segment.begin + i];
    if (axis_.period) distance -= *axis_.period * std::floor(distance / *axis_.period + 0.5);
    kernel[i] = distance * distance / (axis_.width * axis_.width);
    nearest = std::min(nearest, kernel[i]);
  }
  const bool normalised = kind_ == KernelKind::normalised;
  if (!normalised) nearest = 0;
  // kernels, seen from the nearest where they are normalised; none beyond reach
  double sum = 0;
  for (int i = 0; i < active.count; ++i) {
    const double square = kernel[i] - nearest;
    kernel[i] = square > kReach * kReach ? 0 : std::exp(-square / 2);
    sum += kernel[i];
  }
  active.sum = normalised ? sum : 1;
}

}  // namespace warmjoint
