#include "identification/position_ridge.h"

#include "identification/fit_data.h"
#include "identification/identify_maps.h"
#include "identification/position_maps.h"

namespace warmjoint {
namespace {

constexpr const char* kName = "position-ridge";

Estimate Identify(const IdentifierInput& input) {
  MapTask task{kName, ReadMapSettings(input.options), {}, {}};
  if (auto refusal = RefuseForMaps(input, kName, *FindLaw(task.settings.law))) return *refusal;
  const MapPoints points = Kept(PointsOf(input.measurements), input.selection);
  if (auto why = CannotCarry(MapQuantity::position, points)) {
    return Failed(kName, Status::bad_data, *why);
  }
  task.candidates = PositionMaps(input.options, task.settings, points);
  return IdentifyMaps(input, task);
}

}  // namespace

Identifier PositionRidge() {
  std::vector<OptionInfo> options = MapOptions();
  for (const OptionInfo& option : PositionMapOptions()) options.push_back(option);
  return {kName, "a nominal law and a map over position by ridge regression, without warming",
          options, &Identify};
}

}  // namespace warmjoint
