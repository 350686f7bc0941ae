// Rows of a regression on kernels that are local: grouped, so that few zeros are stored or multiplied.
#pragma once

#include <warmjoint/friction.h>

#include <Eigen/Core>
#include <vector>

#include "identification/forward/map_points.h"

namespace warmjoint {

/// Samples at which about the same kernels count (PreparedAxis): the rest is below 3e-13 of the largest.
struct RowGroup {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  std::vector<Eigen::Index> samples;  // rows of the points
  std::vector<Eigen::Index>
      kernels;  // [m] columns, ascending: kernels of all maps, one map after the other
  Rows values;  // [samples x m] factor(v) kappa_i, or 0 where one does not count
};

/// Number of kernels of all maps.
Eigen::Index KernelCount(const std::vector<FrictionMap>& maps);

/// The kernels of the maps (their weights are not read) at the samples first <= i < last of the
/// points, in an order that depends on nothing else.
std::vector<RowGroup> GroupRows(const std::vector<FrictionMap>& maps, const MapPoints& points,
                                Eigen::Index first, Eigen::Index last);

/// The same rows with their zeros: [last - first x kernels].
Eigen::MatrixXd DenseKernels(const std::vector<FrictionMap>& maps, const MapPoints& points,
                             Eigen::Index first, Eigen::Index last);

}  // namespace warmjoint
