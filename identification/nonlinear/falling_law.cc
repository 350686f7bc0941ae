#include "identification/nonlinear/falling_law.h"

#include <algorithm>
#include <cassert>

namespace warmjoint {
namespace {

/// {kv, kc, ks}: both directions alike.
FallingLaw Alike(std::string_view name) {
  return {*FindLaw(name),
          *FindLaw(ViscousCoulomb::name),
          Stribeck::name,
          Eigen::Vector3d(0, -1, 1),
          "static less coulomb",
          [](const double* x) { return x[1]; },
          [](const double* x) { return x[2]; },
          [](double* x, double least, double most) {
            x[2] = std::clamp(x[2], least * x[1], most * x[1]);
          }};
}

/// {kv, kc+, kc-, kr}
FallingLaw Apart(std::string_view name) {
  return {*FindLaw(name),
          *FindLaw(Asymmetric::name),
          AsymmetricStribeck::name,
          Eigen::Vector4d(0, 0, 0, 1),
          kStaticRiseRow.name,
          [](const double* x) { return std::min(x[1], x[2]); },
          [](const double* x) { return 0.5 * (x[1] + x[2]) + x[3]; },
          [](double* x, double least, double most) {
            const double coulomb = std::min(x[1], x[2]);
            x[3] = std::clamp(x[3], (least - 1) * coulomb, (most - 1) * coulomb);
          }};
}

}  // namespace

const FallingLaw& FindFallingLaw(std::string_view name) {
  static const FallingLaw laws[] = {Alike(Stribeck::name), Apart(AsymmetricStribeck::name),
                                    Alike(LuGre::name), Apart(AsymmetricLuGre::name)};
  const auto* found =
      std::ranges::find_if(laws, [&](const FallingLaw& one) { return one.law.name == name; });
  assert(found != std::end(laws));
  return *found;
}

}  // namespace warmjoint
