#include "identification/identifiers/motor_ridge.h"

#include <utility>

#include "identification/maps/identify_maps.h"
#include "identification/maps/motor_maps.h"
#include "identification/physical_bounds.h"

namespace warmjoint::inline identification {
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
  const MotorMapSize size{input.options.Integer("kernels"),
                          input.options.Integer("velocity_kernels"),
                          input.options.Integer("arm_kernels")};
  task.candidates = MotorMaps(size, task.settings, input.measurements.joint, begin.points);
  auto choice = ChooseAndFit(input, task);
  if (!choice) return Refused(kName, Unsolvable());
  if (!task.settings.has_bands) return AsSketch(input, task, std::move(*choice));

  // how sure law and maps are, for intervals and bands
  const MapFit& maps = choice->fit;
  const Uncertainty known = JudgeMaps(choice->problem, maps);
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
  std::vector<OptionInfo> options = MapOptions();
  options.push_back({"kernels", "36", "integer >= 3 <= 128", "kernels over the motor's turn"});
  options.push_back({"velocity_kernels", "3", "integer >= 1 <= 64",
                     "kernels over speed for each direction, beside those over the turn"});
  options.push_back({"arm_kernels", "20", "integer >= 0 <= 128",
                     "kernels over the joint's position for each direction; 0: no such map"});
  options.push_back(GravityOption());
  options.push_back(MotionOption());
  return {kName,
          "a nominal law and maps over the motor's angle and the joint's, without warming; tells "
          "the ripple's multiples of the motor's turn",
          options, &FitMotorMaps};
}

}  // namespace warmjoint::inline identification
