// A fit that grows by the structure found in its residual.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "identification/adequacy/structure.h"
#include "identification/uncertainty/noise_model.h"

namespace warmjoint::inline identification {

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

/// How coefficients scatter, and how far from chance that puts them.
struct BlockEvidence {
  Eigen::MatrixXd scatter;  // [q x q]
  double deviations = 0;
};

/// The fit beside which blocks are tested.
class GrowingFit {
 public:
  /// weight: [m] samples that each row stands for; residual: [m] N.m or N; derivatives: [m x p]
  /// dF/dx; place: where the m rows stand in time; candidates: all blocks that will be asked about:
  /// what they all leave together tells the noise.
  GrowingFit(const Eigen::VectorXd& weight, const Eigen::VectorXd& residual,
             const Eigen::MatrixXd& derivatives, const Selection& place,
             const std::vector<Block>& candidates);

  /// What a block explains beyond the fit; nothing where that may be chance. Its coefficients are
  /// tested by Hotelling's T^2 against two estimates of their scatter: that of the noise as an
  /// autoregressive model of what all blocks leave (noise_model.h), and that of the scores of what
  /// this block leaves over kParts parts of the recording, where enough of them carry its features.
  /// The stronger one counts; for E(0), of which a part or two tell, the first.
  std::optional<Structure> Test(const Block& block) const;

  /// Lets a block join the fit.
  void Take(const Block& block);

  /// [m] what the fit takes up of the residual, N.m or N.
  Eigen::VectorXd Explained() const { return (residual_ - left_).cwiseQuotient(roots_); }

 private:
  Eigen::MatrixXd Normed(const Eigen::MatrixXd& columns) const;
  /// With m / (2 R - 1) samples to tell the noise along the features from, where that has R times
  /// the variance of white noise: for AR(1) noise what the scatter of its coefficient makes of R.
  /// At least 8 beyond the features: what stands out of these is overwhelming, 25 deviations each.
  /// own: [m x q] orthonormal
  BlockEvidence ByColour(const Eigen::VectorXd& coefficients, const Eigen::MatrixXd& own) const;
  void LearnNoise(const std::vector<Block>& candidates);
  void Refit();

  Selection place_;
  Eigen::VectorXi part_;      // [m] of the recording
  Eigen::VectorXd roots_;     // [m] of the weights
  Eigen::RowVectorXd norms_;  // [p] of the weighted derivatives
  Eigen::MatrixXd columns_;   // [m x (p + ...)] weighted, of norm 1
  Eigen::VectorXd residual_;  // [m] weighted
  Eigen::VectorXd left_;      // [m] weighted
  Basis fit_;
  NoiseModel noise_;
  double taken_ = 0;  // columns that were there when the noise was learned
};

}  // namespace warmjoint::inline identification
