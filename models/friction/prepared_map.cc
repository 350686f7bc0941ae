#include "models/friction/prepared_map.h"

#include <algorithm>
#include <cmath>

namespace warmjoint {
namespace {

/// exp(-x^2 / 2) is 1e-16 of its peak here.
constexpr double kReach = 8.6;  // widths

/// How far centres of an even grid may be off, in spacings.
constexpr double kEvenness = 1e-13;

}  // namespace

PreparedAxis::PreparedAxis(const GaussianAxis& axis, KernelKind kind) : axis_(axis), kind_(kind) {
  const int n = static_cast<int>(axis.size());
  if (n > 1) spacing_ = axis.centres[n - 1] - axis.centres[n - 2];

  // with the sides apart, each side is an axis by itself
  const auto zero = std::upper_bound(axis.centres.begin(), axis.centres.end(), 0.0);
  const int negative = static_cast<int>(zero - axis.centres.begin());
  if (axis.sides == Sides::apart) {
    segments_ = {MakeSegment(0, negative), MakeSegment(negative, n)};
  } else {
    segments_ = {MakeSegment(0, n)};
  }

  const double ratio = spacing_ / axis.width;
  double distance = 0;
  do {
    bell_.push_back(std::exp(-distance * distance / 2));
    distance += ratio;
  } while (ratio > 0 && distance < kReach + ratio && bell_.size() < axis.size());
}

PreparedAxis::Segment PreparedAxis::MakeSegment(int begin, int end) const {
  Segment segment{begin, end, end - begin > 1};
  for (int i = begin; i < end; ++i) {
    const double centre = axis_.centres[begin] + (i - begin) * spacing_;
    const double size = std::max(std::abs(axis_.centres[begin]), spacing_);
    if (std::abs(axis_.centres[i] - centre) > kEvenness * size) segment.even = false;
  }
  // a circle must close evenly too
  const double around = (end - begin) * spacing_;
  if (axis_.period && std::abs(around - *axis_.period) > kEvenness * *axis_.period) {
    segment.even = false;
  }
  return segment;
}

int PreparedAxis::Kernels(double x, int* index, double* value) const {
  if (axis_.sides == Sides::apart && x == 0) return 0;
  const Segment& segment = segments_.size() > 1 && x > 0 ? segments_[1] : segments_[0];
  if (segment.begin == segment.end) return 0;
  return segment.even ? EvenKernels(segment, x, index, value)
                      : FreeKernels(segment, x, index, value);
}

int PreparedAxis::EvenKernels(const Segment& segment, double x, int* index, double* value) const {
  const int n = segment.end - segment.begin;
  const bool circle = axis_.period.has_value();

  // the nearest centre, and the distance from it
  double offset = x - axis_.centres[segment.begin];
  if (circle) offset -= *axis_.period * std::floor(offset / *axis_.period);
  const double nearest = std::floor(offset / spacing_ + 0.5);
  const int centre = static_cast<int>(std::clamp(nearest, 0.0, circle ? double(n) : n - 1.0));
  const double distance = (offset - centre * spacing_) / axis_.width;

  // the neighbours that count, up and down; a circle has half of its centres on each side, the
  // opposite one on the side that is nearer
  const int reach = static_cast<int>(bell_.size()) - 1;
  const int nearer = distance > 0 ? n / 2 : (n - 1) / 2;
  const int above = std::min(reach, circle ? nearer : n - 1 - centre);
  const int below = std::min(reach, circle ? n - 1 - nearer : centre);
  const double peak = kind_ == KernelKind::plain ? std::exp(-distance * distance / 2) : 1.0;
  const double up = std::exp(distance * spacing_ / axis_.width);
  const double down = 1 / up;

  int count = 0;
  double sum = 0;
  const auto add = [&](int place, double kernel) {
    index[count] = segment.begin + (circle ? (place + n) % n : place);
    value[count++] = kernel;
    sum += kernel;
  };
  add(centre, peak);
  double power = peak;
  for (int i = 1; i <= above; ++i) add(centre + i, (power *= up) * bell_[i]);
  power = peak;
  for (int i = 1; i <= below; ++i) add(centre - i, (power *= down) * bell_[i]);

  if (kind_ == KernelKind::normalised) {
    for (int i = 0; i < count; ++i) value[i] /= sum;
  }
  return count;
}

int PreparedAxis::FreeKernels(const Segment& segment, double x, int* index, double* value) const {
  const auto squared = [&](int i) {
    double distance = x - axis_.centres[i];
    if (axis_.period) {
      distance -= *axis_.period * std::floor(distance / *axis_.period + 0.5);
    }
    return distance * distance / (2 * axis_.width * axis_.width);
  };

  // normalised kernels by log-sum-exp
  double nearest = 0;
  if (kind_ == KernelKind::normalised) {
    nearest = squared(segment.begin);
    for (int i = segment.begin + 1; i < segment.end; ++i) {
      nearest = std::min(nearest, squared(i));
    }
  }
  int count = 0;
  double sum = 0;
  for (int i = segment.begin; i < segment.end; ++i) {
    const double exponent = squared(i) - nearest;
    if (exponent > kReach * kReach / 2) continue;
    index[count] = i;
    value[count] = std::exp(-exponent);
    sum += value[count++];
  }
  if (kind_ == KernelKind::normalised) {
    for (int i = 0; i < count; ++i) value[i] /= sum;
  }
  return count;
}

/// The kernels of one axis that count at a point.
struct PreparedMap::Active {
  int count;
  std::array<int, kMostMapCentres> index;
  std::array<double, kMostMapCentres> value;
};

PreparedMap::PreparedMap(const FrictionMap& map) : weights_(map.weights), factor_(map.factor) {
  size_t stride = map.size();
  for (const MapAxis& axis : map.axes) {
    stride /= axis.kernels.size();
    quantities_.push_back(axis.quantity);
    axes_.emplace_back(axis.kernels, map.kernels);
    strides_.push_back(stride);
  }
}

template <size_t axis>
double PreparedMap::Sum(const std::array<Active, kMostMapAxes>& active, size_t offset) const {
  const Active& kernels = active[axis];
  const size_t stride = strides_[axis];
  double sum = 0;
  if (axis + 1 == axes_.size()) {
    for (int i = 0; i < kernels.count; ++i) {
      sum += kernels.value[i] * weights_[offset + static_cast<size_t>(kernels.index[i])];
    }
    return sum;
  }
  if constexpr (axis + 1 < kMostMapAxes) {
    for (int i = 0; i < kernels.count; ++i) {
      const size_t next = offset + static_cast<size_t>(kernels.index[i]) * stride;
      sum += kernels.value[i] * Sum<axis + 1>(active, next);
    }
  }
  return sum;
}

double PreparedMap::Value(const MapPoint<double>& point) const {
  std::array<Active, kMostMapAxes> active;
  for (size_t a = 0; a < axes_.size(); ++a) {
    const double x = point[static_cast<size_t>(quantities_[a])];
    active[a].count = axes_[a].Kernels(x, active[a].index.data(), active[a].value.data());
    if (active[a].count == 0) return 0;
  }
  const double velocity = point[static_cast<size_t>(MapQuantity::velocity)];
  return EvaluateFactor(factor_, velocity) * Sum<0>(active, 0);
}

}  // namespace warmjoint
