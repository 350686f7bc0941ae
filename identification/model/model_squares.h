// The squares that a model leaves of a log, and their derivatives.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/forward/row_products.h"
#include "identification/model/minimise.h"
#include "identification/model/model.h"

namespace warmjoint {

/// What a model is fitted to.
struct ModelSamples {
  Eigen::VectorXd time{};                        // [N] s
  Eigen::VectorXd torque{};                      // [N]
  Eigen::Array<bool, Eigen::Dynamic, 1> keep{};  // [N] that count
  std::vector<Eigen::Index> starts{};            // first samples of all recordings but the first
  Eigen::VectorXd weights{};                     // [N] of the squares; or empty: 1
  /// Of the rows that count, whose weights are 1 then; or none.
  const RowTransform* transform = nullptr;
};

/// Rows [J, y - f] of the samples that count, weighted and transformed. [n x P + 1]
ModelRows::Rows RowsToFit(const ModelAt& model, const ModelSamples& samples);

/// Adds what was known before the data, which counts as rows of its own, to sums over the variance of the noise. x: of the model's
/// table, which are the first unknowns of the sums
void AddPriors(const Model& model, const Eigen::VectorXd& x, RowSums& sums);

/// Rows J of the samples that count, made when they are asked for: all of them may be far larger than the log.
class KeptRows {
 public:
  /// model: must outlive this
  KeptRows(const Model& model, const Eigen::VectorXd& x,
           const Eigen::Array<bool, Eigen::Dynamic, 1>& keep);
  /// Rows first <= i < last of the samples that count. [last - first x P]
  Eigen::MatrixXd Between(Eigen::Index first, Eigen::Index last) const;

 private:
  ModelAt model_;
  Eigen::Index size_;               // P
  std::vector<Eigen::Index> kept_;  // [n] samples
  std::vector<SampleRange> stretches_;
  std::vector<HeatState> begins_;  // of each stretch
};

/// (y - f(x))^T W (y - f(x)) over the samples that count, with the priors of the table.
class ModelSquares {
 public:
  /// model, samples: must outlive this.
  ModelSquares(const Model& model, const ModelSamples& samples);

  /// Over a variance of the noise. x: [P]
  RowSums At(const Eigen::VectorXd& x, double variance);
  /// Of the data alone, not over the variance.
  RowSums OfData(const Eigen::VectorXd& x);
  /// torque - force at x, where rows have no transform. [N]
  const Eigen::VectorXd& ResidualAt(const Eigen::VectorXd& x);

 private:
  void MoveTo(const Eigen::VectorXd& x);
  /// The products of the rows, made as they come.
  Eigen::MatrixXd SumAlong(const ModelAt& model);

  const Model& model_;
  const ModelSamples& samples_;
  Eigen::VectorXd roots_;     // [N] of the weights, 0 where a sample does not count
  Eigen::VectorXd x_;         // [P] at which the others are
  Eigen::VectorXd residual_;  // [N]
  Eigen::MatrixXd products_;  // [P + 1 x P + 1] of the rows [J, y - f]
};

}  // namespace warmjoint
