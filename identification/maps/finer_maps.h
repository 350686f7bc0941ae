// The same maps with twice the kernels, and their fit.
#pragma once

#include <optional>
#include <vector>

#include "identification/maps/map_fit.h"

namespace warmjoint {

/// Maps with twice the kernels, at most kMostMapCentres, along their first axis, where that is a position, over the same range and
/// as wide in spacings of their centres; all others stay. Weights are not set.
std::vector<FrictionMap> TwiceAsFine(std::vector<FrictionMap> maps);

/// A fit with twice the kernels, and how far noise alone takes it and the one with its own kernels.
struct FinerFit {
  MapWeights twice;
  Eigen::MatrixXd shaken;        // [p + q x draws] changes of x of the fit with its own
  Eigen::MatrixXd twice_shaken;  // [p + q2 x draws] of twice.x by the same noise
};

/// `fit` again with twice the kernels, and both again with noise added to the torque, as often as kDraws says.
/// problem: of the fit, its maps and rows are not read; noise: of its residual. Nothing where it cannot be solved.
std::optional<FinerFit> FitFiner(MapProblem problem, const MapFit& fit, const NoiseModel& noise);

}  // namespace warmjoint
