#include "identification/identifiers/position_ridge.h"

#include "identification/maps/identify_maps.h"
#include "identification/maps/position_maps.h"

namespace warmjoint::inline identification {
namespace {

constexpr const char* kName = "position-ridge";

Fit FitMap(const IdentifierInput& given) {
  const RigidPart rigid = PrepareRigid(given);
  if (rigid.why) return Refused(kName, {rigid.status, *rigid.why});
  const IdentifierInput input = rigid.Of(given);
  MapBeginning begin = BeginMaps(input, kName, {MapQuantity::position}, rigid);
  if (begin.refusal) return Refused(kName, *begin.refusal);
  begin.task.candidates = PositionMaps(input.options, begin.task.settings, begin.points);
  return IdentifyMaps(input, begin.task);
}

}  // namespace

Identifier PositionRidge() {
  std::vector<OptionInfo> options = MapOptions();
  for (const OptionInfo& option : PositionMapOptions()) options.push_back(option);
  options.push_back(GravityOption());
  options.push_back(MotionOption());
  return {kName, "a nominal law and a map over position by ridge regression, without warming",
          options, &FitMap};
}

}  // namespace warmjoint::inline identification
