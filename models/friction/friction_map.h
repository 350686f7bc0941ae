// Friction as a map over what a joint knows of itself: position, velocity, energy, load.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "models/friction/gaussian_axis.h"

namespace warmjoint::inline models {

/// What a map can depend on.
enum class MapQuantity { position, motor_position, velocity, energy, load };

std::span<const Word<MapQuantity>> WordsOf(MapQuantity);

/// Where a joint is: one value for each MapQuantity, in its order: rad or m, rad, rad/s or m/s,
/// N.m or N, N.m or N.
template <typename T>
using MapPoint = std::array<T, 5>;

struct MapAxis {
  MapQuantity quantity = MapQuantity::position;
  GaussianAxis kernels;

  template <class A>
  void Serialize(A* a) {
    a->Field("quantity", &quantity, {.needed = "name what the map depends on"});
    kernels.Serialize(a);
  }
};

/// What the kernels are multiplied by: 1, sign(v) (a level that acts against the motion) or v
/// (viscous friction). With `velocity` a map over energy is kv(E) v of Eq. (27).
enum class MapFactor { one, direction, velocity };

std::span<const Word<MapFactor>> WordsOf(MapFactor);

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

  template <class A>
  void Serialize(A* a) {
    a->Field("axes", &axes, {.needed = "give a list"});
    a->Field("kernels", &kernels);
    a->Field("factor", &factor);
    a->Field("weights", &weights, {.unit = "N.m", .needed = "give a number for each kernel"});
  }
};

/// The map's axis over that quantity, or nullptr.
const MapAxis* FindAxis(const FrictionMap& map, MapQuantity quantity);

}  // namespace warmjoint::inline models
