// Law, maps and warming together.
#pragma once

#include "identification/maps/identify_maps.h"
#include "identification/warming/gaps.h"
#include "identification/warming/thermal_fit.h"

namespace warmjoint {

/// A fit of F = Fn(v) + maps + sign(v) E over the closed loop.
struct WarmMaps {
  MapTask task;              // with the choice made, and E
  MapFit fit;                // law and maps beside E
  ThermalFit warming;        // of law, one factor on the maps, and all that is told of the heat
  std::vector<LogGap> gaps;  // where E jumps
  /// Drop of |e|^2 that warming brings, over the noise's variance. Where it stays far below what can be seen,
  /// task and fit are not set.
  double visible = 0;
  bool converged = false;
  int rounds = 0;
};

/// Two blocks in turn, each exact for the other: maps and their strength by ridge on what E leaves
/// of the torque; the warming, the law and one factor on the maps by maximum likelihood over the
/// closed loop (thermal_fit.h), until gain and time constant rest to 1e-6. The blocks hardly overlap:
/// a map repeats itself with every pass, warming does not; where they do, as in short logs or around a gap,
/// rounds are mixed by the method of Anderson. At gaps E jumps, as energy-ml has it.
/// task.energy is not read; initial: what is known of E(0). Nothing where no fit can be solved.
std::optional<WarmMaps> FitWarmMaps(const IdentifierInput& input, const MapTask& task,
                                    const InitialEnergy& initial);

/// The same as a fit whose table has law and heat, with intervals and bands of law, warming and
/// maps together; not_identifiable where no warming can be seen or its time constant is vague.
Fit AsFit(const IdentifierInput& input, const WarmMaps& warm);

}  // namespace warmjoint
