// Law, maps and warming together.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "identification/maps/identify_maps.h"
#include "identification/maps/warm_map_fit.h"
#include "identification/warming/gaps.h"
#include "identification/warming/thermal_fit.h"

namespace warmjoint {

/// A fit of F = Fn(v) + maps + sign(v) E over the closed loop.
struct WarmMaps {
  MapTask task;              // with the choice made, and E
  MapFit fit;                // law and maps, given E
  ThermalFit warming;        // its heat: gain, time constant, E(0), jumps
  std::vector<LogGap> gaps;  // where E jumps
  /// Drop of |e|^2 that warming brings, over the noise's variance. Where it stays far below what can be seen,
  /// nothing else is set but the name in `task`.
  double visible = 0;
  bool converged = false;
  /// null where no warming was found in addition to the maps
  std::shared_ptr<WarmMapFit> joint{};
};

/// Least squares of law, maps and heat together over the closed loop (warm_map_fit.h). It begins where two turns of each, given
/// the other, end: maps and their strength by ridge on what E leaves of the torque; the warming, the law and one factor on the
/// maps by maximum likelihood (thermal_fit.h). At gaps E jumps, as energy-ml has it.
/// task.energy is not read; input: must outlive the result; initial: what is known of E(0). Nothing where no fit can be solved.
std::optional<WarmMaps> FitWarmMaps(const IdentifierInput& input, const MapTask& task,
                                    const InitialEnergy& initial);

/// The same as a fit whose table has law and heat, with intervals and bands of law, warming and
/// maps together; not_identifiable where no warming can be seen or its time constant is vague.
Fit AsFit(const IdentifierInput& input, const WarmMaps& warm);

}  // namespace warmjoint
