#include "models/friction/prepared_map.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace warmjoint {
namespace {

/// exp(-x^2 / 2) is 1e-16 of its peak here.
constexpr double kReach = 8.6;  // widths

/// How far centres of an even grid may be off, in spacings, beyond their own rounding.
constexpr double kEvenness = 1e-13;
constexpr double kRounding = 8 * std::numeric_limits<double>::epsilon();

}  // namespace

PreparedAxis::PreparedAxis(const GaussianAxis& axis, KernelKind kind) : axis_(axis), kind_(kind) {
  const int n = static_cast<int>(axis.size());
  // with the sides apart, each side is an axis by itself
  const auto zero = std::upper_bound(axis.centres.begin(), axis.centres.end(), 0.0);
  const int negative = static_cast<int>(zero - axis.centres.begin());
  if (axis.sides == Sides::apart) {
    segments_ = {MakeSegment(0, negative), MakeSegment(negative, n)};
  } else {
    segments_ = {MakeSegment(0, n)};
  }
}

PreparedAxis::Segment PreparedAxis::MakeSegment(int begin, int end) const {
  Segment segment{begin, end};
  const int n = end - begin;
  if (n < 2) return segment;
  segment.spacing = (axis_.centres[end - 1] - axis_.centres[begin]) / (n - 1);
  if (!IsEven(segment)) return segment;
  const double ratio = segment.spacing / axis_.width;
  for (int i = 0; i < n && (i - 1) * ratio < kReach; ++i) {
    segment.bell.push_back(std::exp(-i * ratio * i * ratio / 2));
  }
  return segment;
}

bool PreparedAxis::IsEven(const Segment& segment) const {
  const auto near = [&](double a, double b) {
    const double size = std::max(std::abs(a), std::abs(b));
    return std::abs(a - b) <= kEvenness * segment.spacing + kRounding * size;
  };
  for (int i = segment.begin; i < segment.end; ++i) {
    const double even = axis_.centres[segment.begin] + (i - segment.begin) * segment.spacing;
    if (!near(axis_.centres[i], even)) return false;
  }
  // a circle must close evenly too
  const double around = (segment.end - segment.begin) * segment.spacing;
  return !axis_.period || near(around, *axis_.period);
}

std::vector<size_t> PreparedAxis::Row() const {
  std::vector<size_t> row(axis_.period ? 2 * axis_.size() : axis_.size());
  for (size_t i = 0; i < row.size(); ++i) row[i] = i % axis_.size();
  return row;
}

void PreparedAxis::Kernels(double x, ActiveKernels& active) const {
  active.count = 0;
  if (axis_.sides == Sides::apart && x == 0) return;
  const Segment& segment = segments_.size() > 1 && x > 0 ? segments_[1] : segments_[0];
  if (segment.begin == segment.end) return;
  if (segment.bell.empty()) {
    FreeKernels(segment, x, active);
  } else {
    EvenKernels(segment, x, active);
  }
}

void PreparedAxis::EvenKernels(const Segment& segment, double x, ActiveKernels& active) const {
  const int n = segment.end - segment.begin;
  const bool circle = axis_.period.has_value();

  // the nearest centre, and the distance from it
  double offset = x - axis_.centres[segment.begin];
  if (circle && (offset < 0 || offset >= *axis_.period)) {
    offset -= *axis_.period * std::floor(offset / *axis_.period);
  }
  const double place = std::clamp(offset / segment.spacing, 0.0, circle ? double(n) : n - 1.0);
  const int centre = static_cast<int>(place + 0.5);
  const double distance = (offset - centre * segment.spacing) / axis_.width;

  // the neighbours that count, up and down; a circle has half of its centres on each side, the
  // opposite one on the side that is nearer
  const int reach = static_cast<int>(segment.bell.size()) - 1;
  const int nearer = distance > 0 ? n / 2 : (n - 1) / 2;
  const int above = std::min(reach, circle ? nearer : n - 1 - centre);
  const int below = std::min(reach, circle ? n - 1 - nearer : centre);
  const int first = centre - below;
  active.first = segment.begin + (first < 0 ? first + n : first >= n ? first - n : first);
  active.count = below + 1 + above;

  const bool normalised = kind_ == KernelKind::normalised;
  const double up = std::exp(distance * segment.spacing / axis_.width);
  const double down = 1 / up;
  double* kernel = active.value.data() + below;
  kernel[0] = normalised ? 1.0 : std::exp(-distance * distance / 2);
  double upward = kernel[0], downward = kernel[0], sum = kernel[0];
  for (int i = 1; i <= above; ++i) sum += kernel[i] = (upward *= up) * segment.bell[i];
  for (int i = 1; i <= below; ++i) sum += kernel[-i] = (downward *= down) * segment.bell[i];
  active.sum = normalised ? sum : 1;
}

void PreparedAxis::FreeKernels(const Segment& segment, double x, ActiveKernels& active) const {
  active.first = segment.begin;
  active.count = segment.end - segment.begin;
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
  double sum = 0;
  for (int i = 0; i < active.count; ++i) {
    const double square = kernel[i] - nearest;
    kernel[i] = square > kReach * kReach ? 0 : std::exp(-square / 2);
    sum += kernel[i];
  }
  active.sum = normalised ? sum : 1;
}

PreparedMap::PreparedMap(const FrictionMap& map) : factor_(map.factor) { LayOut(map); }

void PreparedMap::LayOut(const FrictionMap& map) {
  const size_t dimensions = map.axes.size();
  std::vector<size_t> order(dimensions);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return map.axes[a].kernels.size() < map.axes[b].kernels.size();
  });
  std::vector<std::vector<size_t>> rows;
  for (const size_t a : order) {
    quantities_.push_back(map.axes[a].quantity);
    axes_.emplace_back(map.axes[a].kernels, map.kernels);
    rows.push_back(axes_.back().Row());
  }
  strides_.assign(dimensions, 1);
  for (size_t a = dimensions - 1; a > 0; --a) strides_[a - 1] = strides_[a] * rows[a].size();

  // strides of the map's own weights, in the new order
  std::vector<size_t> own(dimensions);
  for (size_t a = 0; a < dimensions; ++a) {
    size_t stride = 1;
    for (size_t b = order[a] + 1; b < dimensions; ++b) stride *= map.axes[b].kernels.size();
    own[a] = stride;
  }
  weights_.resize(strides_[0] * rows[0].size());
  for (size_t i = 0; i < weights_.size(); ++i) {
    size_t from = 0;
    for (size_t a = 0; a < dimensions; ++a) {
      from += own[a] * rows[a][i / strides_[a] % rows[a].size()];
    }
    weights_[i] = map.weights[from];
  }
}

template <size_t axis>
double PreparedMap::Sum(const Active& active, const double* weights) const {
  const ActiveKernels& kernels = active[axis];
  weights += static_cast<size_t>(kernels.first) * strides_[axis];
  if (axis + 1 == axes_.size()) {
    using Row = Eigen::Map<const Eigen::VectorXd>;
    return Row(kernels.value.data(), kernels.count).dot(Row(weights, kernels.count));
  }
  double sum = 0;
  if constexpr (axis + 1 < kMostMapAxes) {
    for (int i = 0; i < kernels.count; ++i) {
      sum += kernels.value[static_cast<size_t>(i)] * Sum<axis + 1>(active, weights);
      weights += strides_[axis];
    }
  }
  return sum;
}

double PreparedMap::Value(const MapPoint<double>& point) const {
  Active active;
  double divisor = 1;
  for (size_t a = 0; a < axes_.size(); ++a) {
    axes_[a].Kernels(point[static_cast<size_t>(quantities_[a])], active[a]);
    if (active[a].count == 0) return 0;
    divisor *= active[a].sum;
  }
  const double velocity = point[static_cast<size_t>(MapQuantity::velocity)];
  return EvaluateFactor(factor_, velocity) * Sum<0>(active, weights_.data()) / divisor;
}

}  // namespace warmjoint
