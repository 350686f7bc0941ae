// A fit that grows by the structure found in its residual.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "identification/adequacy/structure.h"
#include "sim/dataset/selection.h"

namespace warmjoint {

/// Features that a residual may depend on, asked about together.
struct Block {
  Dependence on;
  Eigen::MatrixXd features;  // [m x q]; q = 0: nothing to ask
};

/// An orthonormal basis of columns, and how it is made of them: basis = columns * mix.
struct Basis {
  Eigen::MatrixXd basis;  // [m x r]
  Eigen::MatrixXd mix;    // [q x r]
};

/// The fit beside which blocks are tested.
class GrowingFit {
 public:
  /// weight: [m] samples that each row stands for; residual: [m] N.m or N; derivatives: [m x p]
  /// dF/dx; place: where the m rows stand in time, for the colour of the noise.
  GrowingFit(const Eigen::VectorXd& weight, const Eigen::VectorXd& residual,
             const Eigen::MatrixXd& derivatives, const Selection& place);

  /// What a block explains beyond the fit; nothing where that may be chance. Its coefficients are
  /// tested by Hotelling's T^2 against two estimates of their scatter, both from what the block
  /// leaves: that of an autoregressive noise (noise_model.h), which finds what is gone soon, and
  /// that of the scores over kParts parts of the recording, which finds what would pass for
  /// coloured noise. The stronger one counts. E(0), gone within a part or two, is left to the
  /// first.
  std::optional<Structure> Test(const Block& block) const;

  /// Lets a block join the fit.
  void Take(const Block& block);

  /// [m] what the fit takes up of the residual, N.m or N.
  Eigen::VectorXd Explained() const { return (residual_ - left_).cwiseQuotient(roots_); }

 private:
  Eigen::MatrixXd Normed(const Eigen::MatrixXd& columns) const;
  void Refit();

  Selection place_;
  Eigen::VectorXi part_;      // [m] of the recording
  Eigen::VectorXd roots_;     // [m] of the weights
  Eigen::RowVectorXd norms_;  // [p] of the weighted derivatives
  Eigen::MatrixXd columns_;   // [m x (p + ...)] weighted, of norm 1
  Eigen::VectorXd residual_;  // [m] weighted
  Eigen::VectorXd left_;      // [m] weighted
  Basis fit_;
};

}  // namespace warmjoint
