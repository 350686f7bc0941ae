// Rows on local kernels, made once for several fits to the same samples.
#pragma once

#include <memory>
#include <vector>

#include "identification/ridge/local_rows.h"

namespace warmjoint {

/// The rows of all samples, in contiguous spans of as many samples each.
class KernelRows {
 public:
  /// maps: their weights are not read; points: [n x 5]; spans: at least 1.
  KernelRows(const std::vector<FrictionMap>& maps, const MapPoints& points, Eigen::Index spans);

  /// Whether so many samples' rows are small enough to be kept.
  static bool Fit(const std::vector<FrictionMap>& maps, Eigen::Index samples);

  /// Rows to keep for several fits; null where they are too many.
  static std::shared_ptr<const KernelRows> Kept(const std::vector<FrictionMap>& maps,
                                                const MapPoints& points, Eigen::Index spans);

  Eigen::Index spans() const { return static_cast<Eigen::Index>(groups_.size()); }

  /// Normal equations of one span, as LocalNormal. free: [n x p]; y: [n]
  NormalEquations Normal(Eigen::Index span, const Eigen::MatrixXd& free,
                         const Eigen::VectorXd& y) const;
  /// Of all of them.
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
