// Least squares of a law with the Stribeck effect over a recorded motion, with or without warming, by Ceres.
#pragma once

#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "identification/model/model.h"
#include "identification/nonlinear/falling_law.h"
#include "identification/options.h"
#include "identification/warming/scan_time_constant.h"

namespace warmjoint {

/// The options of a fit of such a law.
struct StribeckOptions {
  FallingLawOf<SteadyFallingLaws> law{};
  PartFit warming = PartFit::none;
  double exponent = 2;

  template <class A>
  void Serialize(A* a) {
    a->Field("law", &law, {.meaning = "one Coulomb level, or one for each direction"});
    a->Field("warming", &warming, {.meaning = "whether friction warms up"});
    a->Field("exponent", &exponent,
             {.bounds = {.at_least = 0.1, .at_most = 10},
              .meaning = "the law's stribeck_exponent, fixed"});
  }
};

/// The law and the samples of a fit.
struct StribeckProblem {
  const LogSamples& measurements;
  const Selection& selection;  // E runs over all samples, the fit is to those kept
  double exponent = 2;         // delta, fixed
  PartFit warming = PartFit::none;
  const FallingLaw& law = FindFallingLaw(Stribeck::name);  // one of SteadyFallingLaws
  Eigen::MatrixXd rigid{};  // [N x q] gravity and inertia, the last unknowns of x; [0 x 0]: none

  FallingPlaces places() const {
    FallingPlaces at = law.places;
    if (warming == PartFit::estimated) at.heat = 2;
    at.rigid = rigid.cols();
    return at;
  }
};

/// Columns, followed by those of the problem's rigid part. columns: [N x d]; returns [N x d + q]
Eigen::MatrixXd BesideRigid(const Eigen::MatrixXd& columns, const StribeckProblem& problem);

/// A start for columns of friction, the rigid part that follows them and the warming (ScanBeside). columns: [N x d]; rigid: [q] of
/// a fit without warming; parameters of what it returns: [d + q]
InitialGuess ScanWarming(const Eigen::MatrixXd& columns, const Eigen::VectorXd& rigid,
                         const StribeckProblem& problem);

/// The best x on a grid of 16 values of vs, even in ln vs from a third of the slowest kept speed to
/// the fastest one. Given vs the law is linear in the rest (Golub and Pereyra 1973); with warming,
/// tau is scanned as well (scan_time_constant.h). Best first; values of vs for which the law's
/// columns are alike are left out.
std::vector<FitPoint> ScanStribeckVelocity(const StribeckProblem& problem);

struct StribeckFit {
  FitPoint solution;  // x: law, ln vs, heat, gravity and inertia; squares: (N.m)^2 or N^2
  std::shared_ptr<const Model> model;
  Eigen::VectorXd fitted;    // [n] F + G + M a, N.m or N, over the kept samples
  Eigen::MatrixXd cofactor;  // [p x p] (J^T J)^-1
  bool converged = false;
};

/// Minimises the sum of squares from a start by Ceres, over the rows of a model (model/model.h): friction that falls with
/// speed, its heat, gravity and inertia.
StribeckFit RefineStribeck(const StribeckProblem& problem, const FitPoint& start);

}  // namespace warmjoint
