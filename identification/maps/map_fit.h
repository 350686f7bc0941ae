// Law and maps fitted together, and the uncertainty of the fit.
#pragma once

#include <warmjoint/friction.h>

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "identification/maps/local_rows.h"
#include "identification/model/conditions.h"
#include "identification/model/normal_equations.h"
#include "identification/table.h"
#include "identification/uncertainty/uncertainty.h"

namespace warmjoint {

/// Columns of the law, or others without a prior, that the kernels can imitate, to a thousandth of their squares: only the
/// prior distinguishes these from a map. gram: [d x d] A^T A of `free` such columns and the kernels; ascending.
std::vector<Eigen::Index> ImitatedColumns(const Eigen::MatrixXd& gram, Eigen::Index free);

/// Those of them that have a bound, since only columns of the law have one. lower: [free]
std::vector<Eigen::Index> ImitatedLaw(const Eigen::MatrixXd& gram, Eigen::Index free,
                                      const std::vector<double>& lower);

/// A law that is linear in its parameters, and kernels with a Gaussian prior N(0, s_w^2) on their
/// weights alone, on the n samples that a selection keeps:
///   y = free p + sum_i w_i kappa_i + e.
struct MapProblem {
  std::vector<FrictionMap> maps;  // shapes; their weights are not read
  MapPoints points;               // [n x 5]
  Eigen::MatrixXd free;           // [n x p]
  Eigen::VectorXd torque;         // [n] y, N.m or N
  Selection selection;            // n of its samples are kept
  std::vector<double> lower{};    // [p] bounds of the parameters
  Eigen::Index of_law = 0;  // the first so many of p are the law's, the others gravity and inertia
  /// The rows of `maps` at `points`, where they were computed already; null: computed anew.
  std::shared_ptr<const KernelRows> rows{};
};

/// The normal equations of all rows [free, kernels].
NormalEquations NormalOf(const MapProblem& problem);

struct MapWeights {
  Slice of_law, of_rigid, of_weights;  // places in x: p of law, gravity and inertia, then q
  Eigen::VectorXd x;                   // [p + q]
  double strength = 0;                 // s
  Eigen::VectorXd fitted{};            // [n] N.m or N
  std::vector<FrictionMap> maps{};     // with their weights
  std::vector<bool> unseen{};          // [q] kernels without data (holes.h)

  Eigen::Index free() const { return of_weights.begin; }  // p
  Eigen::VectorXd law() const { return of_law.Of(x); }
  Eigen::VectorXd rigid() const { return of_rigid.Of(x); }
  Eigen::VectorXd weights() const { return of_weights.Of(x); }
};

/// And how sure they are.
struct MapFit : MapWeights {
  double effective = 0;     // trace of the hat matrix
  Eigen::MatrixXd gram;     // [p + q]^2 A^T A
  Eigen::MatrixXd inverse;  // [p + q]^2 (A^T A + s P)^-1
};

/// argmin |y - A x|^2 + s w^T P w, s P: PenaltyOf (holes.h). How much of a column x_j of the law that kernels can imitate
/// (ImitatedColumns) is in the law and how much in the maps does not depend on the data. The maps are what
/// deviates from the law there, x_j^T (kernels w) = 0 over the samples, as smooth terms of additive models are
/// centred (Wood 2017, 5.4.1); where that puts the parameter below its bound and the data do not contradict the bound, it is
/// held there. Nothing where the system is singular to rounding or overflows.
/// normal: NormalOf(problem).
std::optional<MapFit> FitMaps(const MapProblem& problem, NormalEquations normal, double strength);

/// FitMaps to one torque after the other on the same rows: what depends only on the rows is computed once, and the latest
/// conditions are kept.
class RepeatedFit {
 public:
  /// problem: must outlive this; normal: NormalOf(problem).
  RepeatedFit(const MapProblem& problem, NormalEquations normal, double strength);

  /// Fits problem.torque, or the latest torque. Nothing where the system is singular to rounding or overflows.
  std::optional<MapWeights> Fit();
  /// Fits another torque, [n] N.m or N.
  std::optional<MapWeights> To(const Eigen::VectorXd& torque);
  /// The weights at some x, [p + q].
  MapWeights At(Eigen::VectorXd x) const;
  /// The conditions of the latest fit.
  const Conditions& conditions() const { return latest_->conditions(); }
  /// s P of the kernels, [q x q].
  Eigen::MatrixXd penalty() const;
  /// x of each of k torques alone, [p + q x k]. torques: [n x k] N.m or N
  std::optional<Eigen::MatrixXd> Solve(const Eigen::MatrixXd& torques);
  /// The latest solution, and how sure it is. That is found without the bounds of columns that the data determine, since how
  /// sure these are follows from the fit without bounds.
  MapFit Complete(MapWeights latest) const;

 private:
  /// The conditions of `deviating_`, but with the bounds that hold for this torque, where the bounds of columns that the maps
  /// cannot imitate come last; and these columns.
  struct Bounds {
    Conditions conditions;
    std::vector<Eigen::Index> columns;
  };
  Bounds Bounded() const;
  /// x for the torque in `normal_`, [p + q].
  std::optional<Eigen::VectorXd> Unknowns();
  /// Products of all rows with each torque, [p + q x k].
  Eigen::MatrixXd Products(const Eigen::Ref<const Eigen::MatrixXd>& torques) const;

  const MapProblem& problem_;
  NormalEquations normal_;
  double strength_;
  std::vector<bool> unseen_;                      // [q] kernels without data
  Eigen::MatrixXd gram_;                          // [p + q]^2 with the prior
  std::vector<Eigen::Index> shared_;              // columns of the law that the maps can imitate
  std::shared_ptr<const Conditioned> plain_;      // without conditions
  std::shared_ptr<const Conditioned> deviating_;  // with the maps orthogonal to such columns
  std::shared_ptr<const Conditioned> latest_;
};

/// The maps with their weights, one map's after the other's. weights: [q]
std::vector<FrictionMap> WithWeights(std::vector<FrictionMap> maps, const Eigen::VectorXd& weights);

/// The uncertainty of its parameters and weights (uncertainty.h).
Uncertainty MapCovariance(const MapProblem& problem, const MapFit& fit);

/// Sum of maps at some points, [n] N.m or N.
Eigen::VectorXd EvaluateMaps(const std::vector<FrictionMap>& maps, const MapPoints& points);

}  // namespace warmjoint
