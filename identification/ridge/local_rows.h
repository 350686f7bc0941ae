// Rows of a regression on kernels that are local: grouped, so that zeros are neither stored nor
// multiplied.
#pragma once

#include <vector>

#include "identification/forward/map_points.h"
#include "identification/ridge/ridge.h"

namespace warmjoint::inline identification {

/// Samples at which the same kernels count (PreparedAxis): the rest is below 3e-13 of the largest.
struct RowGroup {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  std::vector<Eigen::Index> samples;  // rows of the points
  std::vector<Eigen::Index> kernels;  // [m] columns: kernels of all maps, one map after the other
  Rows values;                        // [samples x m] factor(v) kappa_i
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

/// Adds the rows [free columns, kernels] of the groups. free: [N x p]; y: [N]; both over the
/// points' rows. normal: of size p + kernels.
void AddGroups(const std::vector<RowGroup>& groups, const Eigen::MatrixXd& free,
               const Eigen::VectorXd& y, NormalEquations& normal);

/// Normal equations of the samples first <= i < last, in chunks, so that the memory that it needs
/// does not grow with their number.
NormalEquations LocalNormal(const std::vector<FrictionMap>& maps, const MapPoints& points,
                            const Eigen::MatrixXd& free, const Eigen::VectorXd& y,
                            Eigen::Index first, Eigen::Index last);

/// Mean squared error of leaving out one row at a time, e_i / (1 - h_i), of the ridge on the rows
/// [free columns, kernels]. normal: theirs; strength > 0. Infinite where it is singular.
double LeaveOneOut(const std::vector<RowGroup>& groups, const Eigen::MatrixXd& free,
                   const Eigen::VectorXd& y, const NormalEquations& normal, double strength);

}  // namespace warmjoint::inline identification
