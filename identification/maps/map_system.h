// The equations of law and maps, factored once for any torque.
#pragma once

#include <warmjoint/friction.h>

#include <Eigen/Cholesky>
#include <memory>
#include <optional>
#include <vector>

#include "identification/ridge/ridge.h"

namespace warmjoint {

/// Linear conditions on the unknowns: rows x = values.
struct Conditions {
  Eigen::MatrixXd rows;    // [k x d], independent of each other
  Eigen::VectorXd values;  // [k]

  bool operator==(const Conditions& other) const {
    return rows == other.rows && values == other.values;
  }
};

/// gram x = product under conditions, by the projection onto what they leave.
class Conditioned {
 public:
  /// gram: [d x d]
  Conditioned(const Eigen::MatrixXd& gram, Conditions conditions);

  /// False where there is nothing to solve.
  bool works() const { return held_.info() == Eigen::Success; }
  const Conditions& conditions() const { return conditions_; }

  /// product: [d]; returns x, [d]
  Eigen::VectorXd Solve(const Eigen::VectorXd& product) const;
  /// [d x d] of rank d - k.
  Eigen::MatrixXd Inverse() const;

 private:
  Conditions conditions_;
  double firm_;
  Eigen::LLT<Eigen::MatrixXd> held_;
  Eigen::MatrixXd along_;               // [d x k]
  Eigen::LDLT<Eigen::MatrixXd> small_;  // [k x k]
};

/// (A^T A + s P) x = A^T y of FitMaps (map_fit.h) on the same rows A for any y: what depends on the rows
/// alone is made once, and the latest conditions that a torque asked for are kept.
class MapSystem {
 public:
  /// maps: their weights are not read; gram: [d x d] A^T A of p columns of the law and others and the
  /// kernels; unseen: [q] kernels without data; lower: [p] bounds, or empty: none.
  MapSystem(const std::vector<FrictionMap>& maps, const Eigen::MatrixXd& gram, Eigen::Index free,
            double strength, const std::vector<bool>& unseen, std::vector<double> lower);

  /// [d] x for the torque in `normal`, whose Gram matrix is that of the rows; nothing where the system is
  /// singular to rounding or overflows.
  std::optional<Eigen::VectorXd> Solve(const NormalEquations& normal);

  /// [d x d] (A^T A + s P)^-1 under the conditions of the latest x, but for the bounds of columns that the
  /// data tell: how sure these are is a matter of the fit without.
  Eigen::MatrixXd Inverse() const;

 private:
  /// The conditions of `deviating_`, but with the bounds that hold for this torque, those of columns that the maps
  /// cannot be last; and these columns.
  struct Bounds {
    Conditions conditions;
    std::vector<Eigen::Index> columns;
  };
  Bounds Bounded(const NormalEquations& normal) const;

  Eigen::MatrixXd gram_;                          // [d x d] with the prior
  std::vector<double> lower_;                     // [p] or empty
  std::vector<Eigen::Index> shared_;              // columns that law and maps both can be
  std::shared_ptr<const Conditioned> plain_;      // without conditions
  std::shared_ptr<const Conditioned> deviating_;  // the maps are what deviates from the law
  std::shared_ptr<const Conditioned> latest_;
};

}  // namespace warmjoint
