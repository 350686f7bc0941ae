// What identifiers with maps share: from candidates of maps to an estimate.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "identification/identifier.h"
#include "identification/maps/map_options.h"

namespace warmjoint::inline identification {

struct MapTask {
  std::string identifier;
  MapSettings settings;
  /// Shapes of the maps to choose from, at least one.
  std::vector<std::vector<FrictionMap>> candidates;
  /// [N] E, N.m or N, as far as it is known: sign(v) E is taken off the torque. Empty: 0.
  Eigen::VectorXd energy;
};

/// Where an identifier with maps begins: its settings, and the samples that it fits.
struct MapBeginning {
  MapTask task;                     // without candidates
  MapPoints points;                 // [n x 5] of the kept samples
  std::optional<Estimate> refusal;  // instead of both, where law or maps cannot be fitted
};

/// Reads the options that all identifiers with maps share (map_options.h) and looks whether the
/// data tell the law's parameters apart and vary in each of the quantities that maps are wanted
/// over. identifier: its name.
MapBeginning BeginMaps(const IdentifierInput& input, const std::string& identifier,
                       std::initializer_list<MapQuantity> quantities);

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

/// Appends the law's parameters; those that the kernels can imitate get no interval and a
/// warning, for only the prior's taste tells them from a map.
void ReportLawBesideMaps(const Law& law, const MapFit& fit, const Uncertainty& known,
                         const Measurements& measurements, Estimate& estimate);

/// "20 position x 2 velocity kernels and 36 motor_position kernels".
std::string ShapeOf(const std::vector<FrictionMap>& maps);

/// Law, maps, bands, metrics and message of a fit as an estimate. known: JudgeMaps.
Estimate ReportMaps(const IdentifierInput& input, const MapTask& task, const MapFit& fit,
                    const Uncertainty& known);

/// All of the above.
Estimate IdentifyMaps(const IdentifierInput& input, const MapTask& task);

}  // namespace warmjoint::inline identification
