#include <algorithm>
#include <cmath>
#include <limits>

#include "models/friction/prepared_map.h"
#include "models/friction/row_table.h"

namespace warmjoint {
namespace {

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
