#include "identification/maps/position_maps.h"

namespace warmjoint::inline identification {

std::vector<OptionInfo> PositionMapOptions() {
  return {
      {"basis", "direction", "position|direction|velocity",
       "kernels over position alone (10), one part for each direction of motion, or over position "
       "x velocity (14)"},
      {"kernels", "0", "integer >= 0 <= 128",
       "kernels over position; 0: chosen from 10, 20, 40, 80 and 128"},
      {"velocity_kernels", "3", "integer >= 1 <= 64",
       "kernels over speed for each direction, with basis velocity"},
  };
}

std::vector<OptionInfo> PositionPartOptions(const std::string& allowed,
                                            const std::string& meaning) {
  std::vector<OptionInfo> options = MapOptions();
  // the law, which is no part of the map, has a row elsewhere
  options.front() = {"position", "none", allowed, meaning};
  for (OptionInfo& option : PositionMapOptions()) options.push_back(std::move(option));
  for (size_t i = 1; i < options.size(); ++i) {
    options[i].meaning = "of the map: " + options[i].meaning;
  }
  return options;
}

FrictionMap PositionMap(const MapPoints& points, KernelKind kernels, int count, double width,
                        int speeds) {
  FrictionMap map{{RangeAxis(MapQuantity::position, points, count, width)}, kernels, {}};
  if (speeds > 0) map.axes.push_back(VelocityAxis(points, speeds, width));
  return map;
}

std::vector<std::vector<FrictionMap>> PositionMaps(const Options& options,
                                                   const MapSettings& settings,
                                                   const MapPoints& points) {
  const std::string& basis = options.Text("basis");
  const int given = options.Integer("kernels");
  const std::vector<int> counts = given > 0 ? std::vector{given} : std::vector{10, 20, 40, 80, 128};
  // centres over speed in each direction; none where both directions share the map
  const int speeds = basis == "position"   ? 0
                     : basis == "velocity" ? options.Integer("velocity_kernels")
                                           : 1;
  std::vector<std::vector<FrictionMap>> candidates;
  for (const int count : counts) {
    for (const double width : settings.widths) {
      candidates.push_back({PositionMap(points, settings.kernels, count, width, speeds)});
    }
  }
  return candidates;
}

}  // namespace warmjoint::inline identification
