// Law and maps fitted together, and how sure the fit is.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "identification/maps/map_system.h"
#include "identification/ridge/kernel_rows.h"
#include "identification/uncertainty/uncertainty.h"

namespace warmjoint {

/// A law that is linear in its parameters, and kernels with a Gaussian prior N(0, s_w^2) on their
/// weights alone, on the n samples that a selection keeps:
///   y = free p + sum_i w_i kappa_i + e.
struct MapProblem {
  std::vector<FrictionMap> maps;  // shapes; their weights are not read
  MapPoints points;               // [n x 5]
  Eigen::MatrixXd free;           // [n x p]
  Eigen::VectorXd torque;         // [n] y, N.m or N
  Selection selection;            // n of its samples are kept
  std::vector<double> lower{};    // [p] bounds of the parameters; or empty: none
  /// Of `maps` at `points`, where they are made already; null: made anew.
  std::shared_ptr<const KernelRows> rows{};
};

/// The normal equations of all rows [free, kernels].
NormalEquations NormalOf(const MapProblem& problem);

struct MapWeights {
  Eigen::Index free = 0;          // p
  Eigen::VectorXd x;              // [p + q] parameters, weights
  double strength = 0;            // s
  Eigen::VectorXd fitted;         // [n] N.m or N
  std::vector<FrictionMap> maps;  // with their weights
  std::vector<bool> unseen;       // [q] kernels without data (holes.h)
};

/// And how sure they are.
struct MapFit : MapWeights {
  double effective = 0;     // trace of the hat matrix
  Eigen::MatrixXd gram;     // [p + q]^2 A^T A
  Eigen::MatrixXd inverse;  // [p + q]^2 (A^T A + s P)^-1
};

/// argmin |y - A x|^2 + s w^T P w, P: PriorOf (holes.h). How much of a column x_j of the law that kernels can imitate
/// (imitated_columns.h) stands in the law and how much in the maps is no matter of the data. The maps are what
/// deviates from the law there, x_j^T (kernels w) = 0 over the samples, as smooth terms of additive models are
/// centred (Wood 2017, 5.4.1); where that puts the parameter below its bound and the data know no better, it is held
/// there. Nothing where the system is singular to rounding or overflows.
std::optional<MapFit> FitMaps(const MapProblem& problem, double strength);

/// The same of normal equations that are made already: NormalOf(problem).
std::optional<MapFit> FitMaps(const MapProblem& problem, NormalEquations normal, double strength);

/// FitMaps to one torque after the other on the same rows.
class RepeatedFit {
 public:
  /// problem: must outlive this; normal: NormalOf(problem).
  RepeatedFit(const MapProblem& problem, NormalEquations normal, double strength);

  /// To problem.torque, or the latest torque.
  std::optional<MapWeights> Fit();
  /// To another torque, [n] N.m or N.
  std::optional<MapWeights> To(const Eigen::VectorXd& torque);
  /// x of each of k torques alone, [p + q x k]. torques: [n x k] N.m or N
  std::optional<Eigen::MatrixXd> Solve(const Eigen::MatrixXd& torques);
  /// The latest, and how sure it is.
  MapFit Complete(MapWeights latest) const;

 private:
  /// Products of all rows with each torque, [p + q x k].
  Eigen::MatrixXd Products(const Eigen::Ref<const Eigen::MatrixXd>& torques) const;

  const MapProblem& problem_;
  NormalEquations normal_;
  double strength_;
  std::vector<bool> unseen_;
  MapSystem system_;
};

/// The maps with their weights, one map's after the other's. weights: [q]
std::vector<FrictionMap> WithWeights(std::vector<FrictionMap> maps, const Eigen::VectorXd& weights);

/// How sure its parameters and weights are (penalised_uncertainty.h).
Uncertainty MapCovariance(const MapProblem& problem, const MapFit& fit);

/// Sum of maps at some points, [n] N.m or N.
Eigen::VectorXd EvaluateMaps(const std::vector<FrictionMap>& maps, const MapPoints& points);

}  // namespace warmjoint
