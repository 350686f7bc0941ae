// Normal equations of a regression on kernels that are local.
#pragma once

#include <warmjoint/friction.h>

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "identification/forward/log_trajectory.h"
#include "identification/model/normal_equations.h"

namespace warmjoint {

/// Samples at which about the same kernels are not negligible (PreparedAxis): the others are below 3e-13 of the largest.
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

/// Normal equations of the rows [free columns, kernels] of the samples first <= i < last, in chunks, so that the memory that it needs
/// does not grow with their number.
NormalEquations LocalNormal(const std::vector<FrictionMap>& maps, const MapPoints& points,
                            const Eigen::MatrixXd& free, const Eigen::VectorXd& y,
                            Eigen::Index first, Eigen::Index last);

/// The products of the kernels of all samples with each y, in chunks. y: [n x k]; returns [kernels x k].
Eigen::MatrixXd LocalProducts(const std::vector<FrictionMap>& maps, const MapPoints& points,
                              const Eigen::Ref<const Eigen::MatrixXd>& y);

/// Mean squared error of leaving out one row at a time, e_i / (1 - h_i), of the ridge on the rows
/// [free columns, kernels]. normal: theirs; strength > 0. Infinite where it is singular.
double LeaveOneOut(const std::vector<RowGroup>& groups, const Eigen::MatrixXd& free,
                   const Eigen::VectorXd& y, const NormalEquations& normal, double strength);

/// The rows of all samples, in contiguous spans of as many samples each.
class KernelRows {
 public:
  /// maps: their weights are not read; points: [n x 5]; spans: at least 1.
  KernelRows(const std::vector<FrictionMap>& maps, const MapPoints& points, Eigen::Index spans);

  /// Rows to keep for several fits; null where they are too many.
  static std::shared_ptr<const KernelRows> Kept(const std::vector<FrictionMap>& maps,
                                                const MapPoints& points, Eigen::Index spans);

  Eigen::Index spans() const { return static_cast<Eigen::Index>(groups_.size()); }

  /// Normal equations of one span, as LocalNormal. free: [n x p]; y: [n]
  NormalEquations Normal(Eigen::Index span, const Eigen::MatrixXd& free,
                         const Eigen::VectorXd& y) const;
  /// Normal equations of all spans.
  NormalEquations Normal(const Eigen::MatrixXd& free, const Eigen::VectorXd& y) const;

  /// Products of the rows with each of k torques: [kernels x k]. y: [n x k]
  Eigen::MatrixXd Products(const Eigen::Ref<const Eigen::MatrixXd>& y) const;

  /// The rows times weights: the maps' values at each sample, [n]. weights: [kernels]
  Eigen::VectorXd Times(const Eigen::VectorXd& weights) const;

 private:
  Eigen::Index samples_;
  Eigen::Index kernels_;
  std::vector<std::vector<RowGroup>> groups_;  // of each span
};

}  // namespace warmjoint
