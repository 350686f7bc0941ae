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
inline void AxisKernels(const GaussianAxis& axis, KernelKind kind, double x, double* phi) {
  const size_t n = axis.size();
  const auto present = [&](size_t i) {
    return axis.sides == Sides::together || Sign(x) * Sign(axis.centres[i]) > 0;
  };

  // logarithms of the kernels, and the largest of them
  bool any = false;
  double largest = 0;
  for (size_t i = 0; i < n; ++i) {
    if (!present(i)) continue;
    double distance = x - axis.centres[i];
    if (axis.period) distance -= *axis.period * std::floor(distance / *axis.period + 0.5);
    phi[i] = -distance * distance / (2 * axis.width * axis.width);
    if (!any || phi[i] > largest) largest = phi[i];
    any = true;
  }

  const bool normalised = kind == KernelKind::normalised;
  double sum = 0;
  for (size_t i = 0; i < n; ++i) {
    if (!present(i)) {
      phi[i] = 0;
      continue;
    }
    const double exponent = normalised ? phi[i] - largest : phi[i];
    phi[i] = exponent > kUnderflow ? std::exp(exponent) : 0;
    sum += phi[i];
  }
  if (!normalised || !any) return;
  for (size_t i = 0; i < n; ++i) phi[i] /= sum;
}

/// The kernels of each axis of a map at a point.
using MapKernels = std::array<std::array<double, kMostMapCentres>, kMostMapAxes>;

/// The sum of the products of a map's kernels times the weights, over the axes from `axis` on, under one kernel (`offset`) of
/// those before it.
inline double SumOfMap(const FrictionMap& map, const MapKernels& phi, size_t axis, size_t offset) {
  if (axis == map.axes.size()) return map.weights[offset];
  const size_t count = std::min(map.axes[axis].kernels.size(), kMostMapCentres);
  double sum = 0;
  for (size_t i = 0; i < count; ++i) {
    if (phi[axis][i] == 0) continue;
    sum += phi[axis][i] * SumOfMap(map, phi, axis + 1, offset * count + i);
  }
  return sum;
}

/// factor(v) of a map.
inline double EvaluateFactor(MapFactor factor, double velocity) {
  if (factor == MapFactor::velocity) return velocity;
  return factor == MapFactor::direction ? Sign(velocity) : 1;
}

/// Value of a checked map, N.m or N; allocates nothing.
inline double EvaluateMap(const FrictionMap& map, const MapPoint<double>& point) {
  MapKernels phi{};
  for (size_t a = 0; a < map.axes.size(); ++a) {
    const double x = point[static_cast<size_t>(map.axes[a].quantity)];
    AxisKernels(map.axes[a].kernels, map.kernels, x, phi[a].data());
  }
  const double velocity = point[static_cast<size_t>(MapQuantity::velocity)];
  return EvaluateFactor(map.factor, velocity) * SumOfMap(map, phi, 0, 0);
}

}  // namespace warmjoint
