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

/// The fit that was chosen, and what it was made of.
struct MapChoice {
  MapProblem problem;
  MapFit fit;
};

/// Law and maps on the kept samples: the candidate and the strength with the smallest criterion.
/// Nothing where none can be solved.
std::optional<MapChoice> ChooseAndFit(const IdentifierInput& input, const MapTask& task);

/// The task with the choice made: one candidate, one strength.
MapTask Settled(MapTask task, const MapFit& fit);

/// sign(v) E at the kept samples, [n] N.m or N; 0 for an empty energy. energy: [N].
Eigen::VectorXd TakenByEnergy(const IdentifierInput& input, const Eigen::VectorXd& energy);

/// A sentence on a fit: law, kernels, prior, effective parameters, colour of the noise.
std::string DescribeMapFit(const IdentifierInput& input, const MapTask& task, const MapFit& fit,
                           const NoiseModel& noise);

/// The answer where there is no fit: bad_data.
Estimate Unsolvable(const std::string& identifier);

/// Appends the law's parameters; those that the kernels can imitate get no interval, for only the
/// prior's taste tells them from a map.
void ReportLawBesideMaps(const Law& law, const MapFit& fit, const Uncertainty& known,
                         const Measurements& measurements, Estimate& estimate);

/// "20 position x 2 velocity kernels and 36 motor_position kernels".
std::string ShapeOf(const std::vector<FrictionMap>& maps);

/// Why the law alone cannot be fitted, or the data not used, as an estimate that failed; nothing
/// where all is well.
std::optional<Estimate> RefuseForMaps(const IdentifierInput& input, const std::string& identifier,
                                      const Law& law);

/// Law, maps, bands, metrics and message of a fit as an estimate. known: JudgeMaps.
Estimate ReportMaps(const IdentifierInput& input, const MapTask& task, const MapFit& fit,
                    const Uncertainty& known);

/// All of the above.
Estimate IdentifyMaps(const IdentifierInput& input, const MapTask& task);

}  // namespace warmjoint
