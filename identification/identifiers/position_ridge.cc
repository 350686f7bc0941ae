// position-ridge: a nominal law and a map over the joint's position.
//
// Eqs. (10)-(16): law and Gaussian kernels over position, one part for each direction of motion,
// or over position times velocity.
#include "identification/identifiers/identifier_list.h"
#include "identification/maps/identify_maps.h"
#include "identification/seen_samples.h"

namespace warmjoint {
namespace {

constexpr const char* kName = "position-ridge";

Fit FitMap(const IdentifierInput& given) {
  const RigidPart rigid = PrepareRigid(given);
  if (rigid.why) return Refused(kName, {rigid.status, *rigid.why});
  const IdentifierInput input = rigid.Of(given);
  MapBeginning begin = BeginMaps(input, kName, {MapQuantity::position}, rigid);
  if (begin.refusal) return Refused(kName, *begin.refusal);
  begin.task.candidates = PositionMaps(input.options, begin.points);
  return IdentifyMaps(input, begin.task);
}

}  // namespace

Identifier PositionRidge() {
  return {kName, "a nominal law and a map over position by ridge regression, without warming",
          OptionGroups<LawOption, MapOptions, PositionMapOptions, GravityOption, MotionOption>{},
          &FitMap};
}

}  // namespace warmjoint
