// Normal equations of a regression on kernels that are local.
#pragma once

#include <vector>

#include "identification/ridge/ridge.h"
#include "identification/ridge/row_groups.h"

namespace warmjoint {

/// Adds the rows [free columns, kernels] of the groups. free: [N x p]; y: [N]; both over the
/// points' rows. normal: of size p + kernels.
void AddGroups(const std::vector<RowGroup>& groups, const Eigen::MatrixXd& free,
               const Eigen::VectorXd& y, NormalEquations& normal);

/// Normal equations of the samples first <= i < last, in chunks, so that the memory that it needs
/// does not grow with their number.
NormalEquations LocalNormal(const std::vector<FrictionMap>& maps, const MapPoints& points,
                            const Eigen::MatrixXd& free, const Eigen::VectorXd& y,
                            Eigen::Index first, Eigen::Index last);

/// Adds the products of the groups' rows with each y. y: [N x k] over the points' rows; products: [kernels x k]
void AddProducts(const std::vector<RowGroup>& groups, const Eigen::Ref<const Eigen::MatrixXd>& y,
                 Eigen::MatrixXd& products);

/// Of the kernels of all samples with each y, in chunks. y: [n x k]; returns [kernels x k].
Eigen::MatrixXd LocalProducts(const std::vector<FrictionMap>& maps, const MapPoints& points,
                              const Eigen::Ref<const Eigen::MatrixXd>& y);

/// Mean squared error of leaving out one row at a time, e_i / (1 - h_i), of the ridge on the rows
/// [free columns, kernels]. normal: theirs; strength > 0. Infinite where it is singular.
double LeaveOneOut(const std::vector<RowGroup>& groups, const Eigen::MatrixXd& free,
                   const Eigen::VectorXd& y, const NormalEquations& normal, double strength);

}  // namespace warmjoint
