// Values of kernels, and of maps made of them.
#pragma once

#include <warmjoint/friction.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "models/friction/sign.h"

namespace warmjoint {

/// Below it exp(x) is 0 in double precision, and need not be computed.
inline constexpr double kUnderflow = -746;

/// All kernels of an axis at x, into phi [axis.size()]. Normalised ones by log-sum-exp, so that
/// they do not become 0/0 far from every centre. With the sides apart, kernels on the other side
/// are 0, and all of them are at x = 0.
template <typename T>
void AxisKernels(const GaussianAxis& axis, KernelKind kind, const T& x, T* phi) {
  using std::exp;
  using std::floor;
  const size_t n = axis.size();
  const auto present = [&](size_t i) {
    return axis.sides == Sides::together || Sign(x) * Sign(axis.centres[i]) > 0;
  };

  // logarithms of the kernels, and the largest of them
  bool any = false;
  T largest(0);
  for (size_t i = 0; i < n; ++i) {
    if (!present(i)) continue;
    T distance = x - T(axis.centres[i]);
    if (axis.period) distance -= *axis.period * floor(distance / *axis.period + 0.5);
    phi[i] = -distance * distance / T(2 * axis.width * axis.width);
    if (!any || phi[i] > largest) largest = phi[i];
    any = true;
  }

  const bool normalised = kind == KernelKind::normalised;
  T sum(0);
  for (size_t i = 0; i < n; ++i) {
    if (!present(i)) {
      phi[i] = T(0);
      continue;
    }
    const T exponent = normalised ? T(phi[i] - largest) : phi[i];
    phi[i] = exponent > T(kUnderflow) ? exp(exponent) : T(0);
    sum += phi[i];
  }
  if (!normalised || !any) return;
  for (size_t i = 0; i < n; ++i) phi[i] /= sum;
}

namespace internal {

/// The kernels of each axis at a point, and the sum of their products times the weights.
template <typename T>
struct MapContraction {
  const FrictionMap& map;
  std::array<std::array<T, kMostMapCentres>, kMostMapAxes> phi;

  /// Sums the axes from `axis` on, under one kernel (`offset`) of those before it.
  template <size_t axis>
  T Sum(size_t offset) const {
    if constexpr (axis < kMostMapAxes) {
      if (axis == map.axes.size()) return T(map.weights[offset]);
      const size_t count = std::min(map.axes[axis].kernels.size(), kMostMapCentres);
      T sum(0);
      for (size_t i = 0; i < count; ++i) {
        if (phi[axis][i] == T(0)) continue;
        sum += phi[axis][i] * Sum<axis + 1>(offset * count + i);
      }
      return sum;
    } else {
      return T(map.weights[offset]);
    }
  }
};

}  // namespace internal

/// factor(v) of a map.
template <typename T>
T EvaluateFactor(MapFactor factor, const T& velocity) {
  if (factor == MapFactor::velocity) return velocity;
  return T(factor == MapFactor::direction ? Sign(velocity) : 1);
}

/// Value of a checked map, N.m or N; allocates nothing. T: double, or a dual number.
template <typename T>
T EvaluateMap(const FrictionMap& map, const MapPoint<T>& point) {
  internal::MapContraction<T> contraction{map, {}};
  for (size_t a = 0; a < map.axes.size(); ++a) {
    const T& x = point[static_cast<size_t>(map.axes[a].quantity)];
    AxisKernels(map.axes[a].kernels, map.kernels, x, contraction.phi[a].data());
  }
  const T& velocity = point[static_cast<size_t>(MapQuantity::velocity)];
  return EvaluateFactor(map.factor, velocity) * contraction.template Sum<0>(0);
}

}  // namespace warmjoint
