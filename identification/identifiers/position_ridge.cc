#include "identification/identifiers/position_ridge.h"

#include "identification/maps/identify_maps.h"
#include "identification/maps/position_maps.h"

namespace warmjoint::inline identification {
namespace {

constexpr const char* kName = "position-ridge";

/// With all candidates, unless there is a refusal.
MapBeginning Begin(const IdentifierInput& input, const RigidPart& rigid) {
  MapBeginning begin = BeginMaps(input, kName, {MapQuantity::position}, rigid);
  if (begin.refusal) return begin;
  MapTask& task = begin.task;
  task.candidates = PositionMaps(input.options, task.settings, begin.points);
  return begin;
}

Fit FitMap(const IdentifierInput& given) {
  const RigidPart rigid = PrepareRigid(given);
  if (rigid.why) return Refused(kName, {rigid.status, *rigid.why});
  const IdentifierInput input = rigid.Of(given);
  const MapBeginning begin = Begin(input, rigid);
  if (begin.refusal) return Refused(kName, *begin.refusal);
  return IdentifyMaps(input, begin.task);
}

}  // namespace

std::optional<FrictionMap> MapBesideEnergy(const IdentifierInput& given,
                                           const Eigen::VectorXd& energy) {
  const RigidPart rigid = PrepareRigid(given);
  if (rigid.why) return std::nullopt;
  const IdentifierInput input = rigid.Of(given);
  MapBeginning begin = Begin(input, rigid);
  if (begin.refusal) return std::nullopt;
  begin.task.energy = energy;
  const auto choice = ChooseAndFit(input, begin.task);
  if (!choice) return std::nullopt;
  return choice->fit.maps.front();
}

Identifier PositionRidge() {
  std::vector<OptionInfo> options = MapOptions();
  for (const OptionInfo& option : PositionMapOptions()) options.push_back(option);
  options.push_back(GravityOption());
  options.push_back(MotionOption());
  return {kName, "a nominal law and a map over position by ridge regression, without warming",
          options, &FitMap};
}

}  // namespace warmjoint::inline identification
