// position-ridge: a nominal law and a map over the joint's position.
//
// Eqs. (10)-(16): law and Gaussian kernels over position, one part for each direction of motion,
// or over position times velocity.
#include "identification/fit/seen_samples.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/maps/map_model.h"

namespace warmjoint {

Identifier PositionRidge() {
  static constexpr const char* name = "position-ridge";
  return {name, "a nominal law and a map over position by ridge regression, without warming",
          OptionGroups<LawOption, MapOptions, PositionMapOptions, GravityOption, MotionOption>{},
          [](const IdentifierInput& input) {
            return FitMapModel(
                name, input,
                {.quantities = {MapQuantity::position}, .maps = [&](const MapPoints& points) {
                   return PositionMaps(input.options, points);
                 }});
          }};
}

}  // namespace warmjoint
