// Least squares of a law with the Stribeck effect over a recorded motion, with or without warming, by Ceres.
#pragma once

#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <vector>

#include "identification/nonlinear/falling_law.h"
#include "models/friction/intervals.h"

namespace warmjoint {

/// Whether E of Eqs. (19)-(22) is part of the fit.
enum class FittedWarming { none, estimated };
inline std::span<const Word<FittedWarming>> WordsOf(FittedWarming) {
  static constexpr std::array words{Word{"none", FittedWarming::none},
                                    Word{"estimated", FittedWarming::estimated}};
  return words;
}

/// The options of a fit of such a law.
struct StribeckOptions {
  FallingLawOf<SteadyFallingLaws> law{};
  FittedWarming warming = FittedWarming::none;
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

/// What is fitted to what.
struct StribeckProblem {
  const LogSamples& measurements;
  const Selection& selection;  // E runs over all samples, the fit is to those kept
  Intervals intervals;         // FindIntervals(time, starts)
  double exponent = 2;         // delta, fixed
  FittedWarming warming = FittedWarming::none;
  double scale = 1;                                        // about the torque's rms, N.m or N
  const FallingLaw& law = FindFallingLaw(Stribeck::name);  // one of SteadyFallingLaws

  Layout layout() const { return law.layout(warming == FittedWarming::estimated); }
};

/// The best x on a grid of 16 values of vs, even in ln vs from a third of the slowest kept speed to
/// the fastest one. Given vs the law is linear in the rest (Golub and Pereyra 1973); with warming,
/// tau is scanned as well (scan_time_constant.h). Best first; values of vs for which the law's
/// columns are alike are left out.
std::vector<FitPoint> ScanStribeckVelocity(const StribeckProblem& problem);

struct StribeckFit {
  FitPoint solution;         // squares: (N.m)^2 or N^2
  Eigen::VectorXd fitted;    // [n] N.m or N, over the kept samples
  Eigen::MatrixXd jacobian;  // [n x p] of `fitted` by x, exact (dual numbers)
  bool converged = false;
};

/// Minimises the sum of squares from a start by Levenberg-Marquardt.
StribeckFit RefineStribeck(const StribeckProblem& problem, const FitPoint& start);

}  // namespace warmjoint
