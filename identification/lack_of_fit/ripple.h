// Dependence of a residual on an angle: ripple of any period, alike or not in the two directions.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/lack_of_fit/fitted_model.h"
#include "identification/lack_of_fit/significance.h"
#include "identification/lack_of_fit/table.h"

namespace warmjoint {

/// An angle, or a way, along which ripple is looked for.
struct AngleAxis {
  const LackOfFitTest* test = nullptr;
  Eigen::VectorXd phase;  // [N] 0 to 1: way along the axis, or turn
  double length = 1;      // of the axis, in its own unit
  double step = 1;        // between frequencies, cycles along the axis
  int frequencies = 8;    // step, 2 step, ...
  /// [N] by which each sample's ripple is multiplied, as by a function of its speed; empty: by 1.
  Eigen::VectorXd factor{};
  int factors = 1;  // of which this one is tried

  double FactorOf(Eigen::Index n) const { return factor.size() > 0 ? factor[n] : 1; }
};

/// Looks for ripple factor (a cos(2 pi f phase) + b sin(2 pi f phase)), with a and b for each direction of
/// motion, one frequency after the other: the strongest is tested by Hotelling's T^2 over kParts
/// parts of the recording, its probability times the number of frequencies and factors (Bonferroni), and taken
/// off before the next. What is periodic in time alone has another phase in each part and fails the
/// test. Sums the residual into bins in one pass, so that the frequencies cost no pass each.
/// The finding is that of the strongest frequency, and explains what all that are found explain.
/// velocity: [N]; residual: [N] tau - F, read where kept; what is found is taken off it.
Finding TestAxis(const AngleAxis& axis, const Eigen::VectorXd& velocity, const Selection& selection,
                 Eigen::VectorXd& residual, ErrorLevel& level);

/// The tests along the motor angle, where it is known, and along the travel; beside a map over one of them also for ripple that
/// changes with the speed, as cos(k pi r) does, k = 1 to 4; r: share of the samples that are slower.
std::vector<Finding> TestRipple(const FittedModel& model, const LogSamples& measurements,
                                Eigen::VectorXd& residual, ErrorLevel& level);

}  // namespace warmjoint
