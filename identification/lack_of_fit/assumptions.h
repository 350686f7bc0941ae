// What an answer takes for granted and no test can see, and how much that biases the parameters.
#pragma once

#include "identification/inference/inference.h"
#include "identification/lack_of_fit/circumstances.h"
#include "identification/lack_of_fit/examine.h"
#include "identification/lack_of_fit/fitted_model.h"
#include "identification/lack_of_fit/growing_fit.h"

namespace warmjoint {

/// A log over bins, and a fit to it.
struct OverBins {
  const FittedModel& model;
  const LogSamples& measurements;
  const Bins& bins;
  Eigen::MatrixXd derivatives;  // [m x (p + ...)] dF/dx; by jumps at gaps; by heat within the steps
  WeighedFit fit;               // of these
  Circumstances circumstances;
};

/// Adds the rows that follow from numbers of the log alone.
///
/// held_losses: where the step of the log matters to the warming (fitted_model.h). Where the residual shows that
/// the heat changes within the steps, the parameters become those of such heat. Where it shows that
/// losses are held over each step, there is no row. Where it does not decide, an interval covers both.
/// cold_start, slow_drift, dead_band, gaps: forces of a given size.
///
/// open_start, open_drift, open_curve and open_memory: a force f that an assumption leaves out has
/// a factor c, which joins the fit for one step of least squares. Its interval at the level of the
/// log's tests for lack of fit (significance.h), for noise of any colour, is what no test can rule
/// out. The end of that which is farther from 0, as far as it is possible at all, biases the parameters by
/// -(J^T W J)^-1 J^T W f c.
///   start: f = dF/dE(0); E(0) lies between 0 and the most that the joint warms up.
///   curve: f = s v^2, with its heat or without; c at most the friction at the highest speed.
///   memory: f = s (u - |v|), u: |v| after one of the filters of Circumstances::past; c as of the
///   curve.
///   drift: f = s d(t), against the motion and with its heat, or F t, a sensor whose gain drifts;
///   d = t, or (1 - exp(-t/T))/(1 - exp(-1/T)), T = 1/2, 1/4, 1/8; t: share of the log. The
///   friction that is asked for may be that of the first moment or of the last, d or d - 1. Of all
///   of them the largest counts, for each parameter by itself; c at most the friction, or 1.
///
/// degrees and clock: no residual shows either, where all columns of displacement or of time share the slip.
/// A parameter of dimension torque displacement^a time^b is f = w^a t^b times as large once displacement and time are
/// w and t times as large; each end of its interval changes by (f - 1) of itself, and the larger
/// change counts.
/// degrees: w = pi/180; clock: t = 1.01.
void AddAssumptions(const OverBins& over, const Fit& fit, const Inference& by_noise,
                    Examination& examination);

}  // namespace warmjoint
