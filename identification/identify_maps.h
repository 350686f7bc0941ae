// What identifiers with maps share: from candidates of maps to an estimate.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "identification/identifier.h"
#include "identification/map_options.h"

namespace warmjoint {

struct MapTask {
  std::string identifier;
  MapSettings settings;
  /// Shapes of the maps to choose from, at least one.
  std::vector<std::vector<FrictionMap>> candidates;
  /// [N] E, N.m or N, as far as it is known: sign(v) E is taken off the torque. Empty: 0.
  Eigen::VectorXd energy;
};

/// The fit that was chosen.
struct MapChoice {
  MapFit fit;
  size_t candidate = 0;
};

/// Law and maps on the kept samples: the candidate and the strength with the smallest criterion.
/// Nothing where none can be solved. columns: [N x p] of the law.
std::optional<MapChoice> ChooseAndFit(const IdentifierInput& input, const MapTask& task,
                                      const Eigen::MatrixXd& columns);

/// Why the law alone cannot be fitted, or the data not used, as an estimate that failed; nothing
/// where all is well.
std::optional<Estimate> RefuseForMaps(const IdentifierInput& input, const std::string& identifier,
                                      const Law& law);

/// Puts law, maps, bands, metrics and message of a fit into an estimate.
Estimate ReportMaps(const IdentifierInput& input, const MapTask& task, const MapFit& fit);

/// All of the above.
Estimate IdentifyMaps(const IdentifierInput& input, const MapTask& task);

}  // namespace warmjoint
