// motor-ridge: a nominal law, a map over the joint's angle and one over the motor's.
//
// Ripple repeats with the motor's turn: kernels over mod(gear p, 2 pi) x V on a circle, in addition to a
// part over the joint's position for each direction of motion.
#include "identification/fit/seen_samples.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/maps/energy_ml_maps.h"
#include "identification/maps/map_model.h"

namespace warmjoint {

Identifier MotorRidge() {
  static constexpr const char* name = "motor-ridge";
  return {name,
          "a nominal law and maps over the motor's angle and the joint's, without warming; tells "
          "the ripple's multiples of the motor's turn",
          OptionGroups<LawOption, MapOptions, MotorMapSize, GravityOption, MotionOption>{},
          [](const IdentifierInput& input) {
            return FitMapModel(name, input,
                               {.quantities = {MapQuantity::position, MapQuantity::motor_position},
                                .maps = [&](const MapPoints& points) {
                                  return MotorMaps(input.options.Get<MotorMapSize>(),
                                                   input.options.Get<MapOptions>(),
                                                   input.measurements.joint, points);
                                }});
          }};
}

}  // namespace warmjoint
