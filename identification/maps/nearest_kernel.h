// Which samples belong to which kernel of a map.
#pragma once

#include <optional>
#include <vector>

#include "identification/ridge/local_rows.h"

namespace warmjoint {

/// The kernel whose centre is nearest to a sample along every axis; axes whose sides are apart keep to
/// the sample's side. points: [n x 5]
Eigen::Index NearestKernel(const FrictionMap& map, const MapPoints& points, Eigen::Index sample);

/// How fast the joint moved at each kernel of a map: the median |v| of the samples that it is the nearest kernel of; where
/// there are none, that of the next kernel along the first axis, if any. kept: [n x 5]; returns [q] rad/s or m/s.
std::vector<std::optional<double>> SpeedsAtKernels(const FrictionMap& map, const MapPoints& kept);

}  // namespace warmjoint
