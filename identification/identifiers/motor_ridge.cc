// motor-ridge: a nominal law, a map over the joint's angle and one over the motor's.
//
// Ripple repeats with the motor's turn: kernels over mod(gear p, 2 pi) x V on a circle, beside a
// part over the joint's position for each direction of motion.
#include <utility>

#include "identification/identifiers/identifier_list.h"
#include "identification/maps/identify_maps.h"
#include "identification/maps/motor_maps.h"
#include "identification/physical_bounds.h"
#include "identification/seen_samples.h"

namespace warmjoint {
namespace {

constexpr const char* kName = "motor-ridge";

Fit FitMotorMaps(const IdentifierInput& given) {
  const RigidPart rigid = PrepareRigid(given);
  if (rigid.why) return Refused(kName, {rigid.status, *rigid.why});
  const IdentifierInput input = rigid.Of(given);
  MapBeginning begin =
      BeginMaps(input, kName, {MapQuantity::position, MapQuantity::motor_position}, rigid);
  if (begin.refusal) return Refused(kName, *begin.refusal);
  MapTask& task = begin.task;

  // kernels over the motor's turn, and over the joint's travel beside them
  task.candidates = MotorMaps(input.options.Get<MotorMapSize>(), task.settings,
                              input.measurements.joint, begin.points);
  auto choice = ChooseAndFit(input, task);
  if (!choice) return Refused(kName, Unsolvable());
  if (task.settings.bands == MapBands::none) return AsSketch(input, task, std::move(*choice));

  // how sure law and maps are, for intervals and bands
  const MapFit& maps = choice->fit;
  const Uncertainty known = MapCovariance(choice->problem, maps);
  Fit fit = AsFit(input, task, maps, known);
  if (!GivesFriction(fit)) return fit;

  // what the motor's map shows
  const auto count = static_cast<Eigen::Index>(maps.maps[0].size());
  DescribeMotorRipple(maps.maps[0], known.covariance.block(maps.free, maps.free, count, count),
                      input.measurements, fit);
  return fit;
}

}  // namespace

Identifier MotorRidge() {
  return {kName,
          "a nominal law and maps over the motor's angle and the joint's, without warming; tells "
          "the ripple's multiples of the motor's turn",
          OptionGroups<LawOption, MapOptions, MotorMapSize, GravityOption, MotionOption>{},
          &FitMotorMaps};
}

}  // namespace warmjoint
