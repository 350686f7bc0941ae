// Friction as a map over what a joint knows of itself: position, velocity, energy, load.
#pragma once

#include <algorithm>
#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string_view>
#include <vector>

#include "models/foundation/bad_input.h"
#include "models/friction/gaussian_axis.h"

namespace warmjoint::inline models {

/// What a map can depend on.
enum class MapQuantity { position, motor_position, velocity, energy, load };

/// "position", "motor_position", ...
std::string_view MapQuantityName(MapQuantity quantity);

/// Where a joint is: one value for each MapQuantity, in its order: rad or m, rad, rad/s or m/s,
/// N.m or N, N.m or N.
template <typename T>
using MapPoint = std::array<T, 5>;

struct MapAxis {
  MapQuantity quantity = MapQuantity::position;
  GaussianAxis kernels;
};

/// What the kernels are multiplied by: 1, sign(v) (a level that acts against the motion) or v
/// (viscous friction). With `velocity` a map over energy is kv(E) v of Eq. (27).
enum class MapFactor { one, direction, velocity };

/// "one", "direction", "velocity".
std::string_view MapFactorName(MapFactor factor);

inline constexpr size_t kMostMapAxes = 4;
inline constexpr size_t kMostMapCentres = 128;  // of one axis

/// A force that is added to the law's: factor(v) sum_i w_i kappa_i, Eqs. (10)-(16), where kappa_i
/// is the product of one kernel of each axis (diagonal covariance). A normalised product of kernels
/// is the product of the normalised ones. As part of F it takes part in the losses W = |F v|, (19).
struct FrictionMap {
  std::vector<MapAxis> axes;
  KernelKind kernels = KernelKind::normalised;
  // one for each product, the last axis's index the fastest; N.m or N, over rad/s or m/s where the
  // factor is the velocity
  std::vector<double> weights;
  MapFactor factor = MapFactor::one;

  /// Number of kernels that the axes span.
  size_t size() const;
};

/// The map's axis over that quantity, or nullptr.
const MapAxis* FindAxis(const FrictionMap& map, MapQuantity quantity);

/// Refuses, from `place`, sizes that do not fit, widths or periods that are not positive, centres
/// that do not ascend, an axis with its sides apart that has a centre at 0, numbers not finite.
void CheckMap(const FrictionMap& map, const Place& place);

/// {axes: [{quantity, centres, width, period?, sides: together|apart}], kernels: normalised|plain,
/// factor: one|direction|velocity, weights: [...]}.
nlohmann::json MapToJson(const FrictionMap& map);

/// The inverse; checked.
FrictionMap MapFromJson(const nlohmann::json& json, const Place& place);

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

}  // namespace warmjoint::inline models
