// The common part of identifiers with maps: from candidates of maps to a fit.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "identification/fit/identifier.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/rigid_part.h"
#include "identification/maps/map_options.h"

namespace warmjoint {

struct MapTask {
  std::string identifier;
  LinearLaw law;
  MapOptions settings;
  /// Shapes of the maps to choose from, at least one.
  MapShapes candidates{};
  /// [N] E, N.m or N, as far as it is uncertainty: sign(v) E is subtracted from the torque. Empty: 0.
  Eigen::VectorXd energy{};
  /// Gravity and inertia in addition to law and maps, without a prior; no columns: none.
  RigidPart rigid{};
  /// The rows of the only candidate at the kept samples, where they were computed already; null: computed anew.
  std::shared_ptr<const KernelRows> rows{};

  /// Of cross validation over so many kept samples.
  int folds(Eigen::Index samples) const {
    return std::min(settings.folds, std::max(2, static_cast<int>(samples) / 2));
  }
};

/// The task that options with LawOption and MapOptions ask for, without candidates, gravity and inertia. identifier: its name.
MapTask MakeMapTask(const IdentifierInput& input, const std::string& identifier);

/// Where an identifier with maps begins: its settings, and the samples that it fits.
struct MapBeginning {
  MapTask task;                    // without candidates
  MapPoints points;                // [n x 5] of the kept samples
  std::optional<Refusal> refusal;  // instead of both, where law or maps cannot be fitted
};

/// Reads the options that all identifiers with maps share (map_options.h) and checks, for the samples that `task.rigid` keeps,
/// whether the data distinguish law, gravity and inertia, and vary in each of the quantities that maps are wanted over.
/// identifier: its name.
MapBeginning BeginMaps(const IdentifierInput& given, const std::string& identifier,
                       const std::vector<MapQuantity>& quantities);

/// What is to be fitted, with the choice made.
struct ChosenProblem {
  MapProblem problem;
  NormalEquations normal;  // NormalOf(problem)
  double strength = 0;
};

/// The candidate and the strength with the smallest criterion, on the kept samples. Nothing where none can
/// be solved.
std::optional<ChosenProblem> Choose(const IdentifierInput& input, const MapTask& task);

/// The fit that was chosen, and what it was made of.
struct MapChoice {
  MapProblem problem;
  MapFit fit;
};

/// Choose, and fit.
std::optional<MapChoice> ChooseAndFit(const IdentifierInput& input, const MapTask& task);

/// The task with the choice made: one candidate, one strength.
MapTask Settled(MapTask task, const MapWeights& fit);

/// sign(v) E at the kept samples, [n] N.m or N; 0 for an empty energy. energy: [N].
Eigen::VectorXd TorqueOfEnergy(const IdentifierInput& input, const Eigen::VectorXd& energy);

/// Why there is no fit where the normal equations cannot be solved: bad_data.
Refusal Unsolvable();

/// Law and maps as a fit without warming; where they make a friction, with bands. The table has the
/// law's parameters; those that the kernels can imitate get no interval and a warning, for only the
/// choice of the prior distinguishes them from a map. uncertainty: of law and weights first (MapCovariance), and maybe more.
Fit AsFit(const IdentifierInput& input, const MapTask& task, const MapFit& maps,
          const Uncertainty& uncertainty);

/// The same without bands. The uncertainty costs as much time as the fit, so it is computed only when it is asked for.
Fit AsSketch(const IdentifierInput& input, const MapTask& task, MapChoice choice);

}  // namespace warmjoint
