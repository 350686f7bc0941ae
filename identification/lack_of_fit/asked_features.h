// Features that are asked about together: the products of their columns, which all of their tests share.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace warmjoint {

/// Features that a residual may depend on, asked about together: the best of several candidates.
struct Features {
  Eigen::MatrixXd columns;  // [m x q]; q = 0: nothing to ask
  int candidates = 1;       // of which these explain most
  double period = 0;        // of those, or time constant, s; 0 where they have none
};

/// An orthonormal basis of what features have beside a fit: own = [the fit's basis, features] mix.
struct OwnBasis {
  std::vector<Eigen::Index>
      columns;          // [r + q] of the table, that it is mixed of: the fit's r, then the features
  Eigen::MatrixXd mix;  // [(r + q) x s]
  Eigen::VectorXd b;    // [s] products with the residual: coefficients of least squares

  Eigen::Index size() const { return b.size(); }
};

/// A table of the residual, the fit's basis and all features, with the products of its columns over each part of the
/// rows: tests of features mix these and go through no rows again.
class AskedFeatures {
 public:
  /// residual: [m]; basis: [m x r] orthonormal; features: as many rows; roots: [m] by which their rows are weighed
  /// before their columns get norm 1; ends: one past the last row of each part, ascending.
  AskedFeatures(const Eigen::VectorXd& residual, const Eigen::MatrixXd& basis,
                const std::vector<Features>& features, const Eigen::VectorXd& roots,
                const std::vector<Eigen::Index>& ends);

  /// What the i-th features have beside the fit, as far as it stands out by `distinct` (MixOfDistinct).
  OwnBasis Beside(size_t i, double distinct) const;

  /// Squares of an own basis in each part. [parts]
  Eigen::VectorXd Shares(const OwnBasis& own) const;
  /// Its products with what it and the fit leave of the residual, in each part. [parts x s]
  Eigen::MatrixXd Scores(const OwnBasis& own) const;
  /// Its rows. [m x s]
  Eigen::MatrixXd Rows(const OwnBasis& own) const;

  /// Where features stand in the table, and what they are the best of.
  struct Place {
    Eigen::Index first, count;  // columns
    int candidates;
    double period;
  };
  const Place& place(size_t i) const { return places_[i]; }

  /// [residual, basis, features] [m x (1 + r + q)]
  const Eigen::MatrixXd& table() const { return table_; }
  /// Of its columns with each other over all rows.
  const Eigen::MatrixXd& products() const { return products_; }
  /// Columns of the fit's basis.
  Eigen::Index rank() const { return rank_; }

 private:
  /// The product of two columns in each part. [parts]
  auto ByPart(Eigen::Index i, Eigen::Index j) const {
    return by_part_.col(i < j ? i * table_.cols() + j : j * table_.cols() + i);
  }

  Eigen::Index rank_;
  std::vector<Place> places_;
  Eigen::MatrixXd table_;
  Eigen::MatrixXd by_part_;   // [parts x (1 + r + q)^2], of i <= j
  Eigen::MatrixXd products_;  // [(1 + r + q) x the same]
};

/// Columns weighed by roots, of norm 1; a column of zeros stays one. to: as many columns; returns the norms, [c].
Eigen::RowVectorXd WriteNormed(const Eigen::MatrixXd& columns, const Eigen::VectorXd& roots,
                               Eigen::Ref<Eigen::MatrixXd> to);

}  // namespace warmjoint
