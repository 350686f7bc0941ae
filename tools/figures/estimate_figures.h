// The families of pictures that an estimate and its recording give, and the one list of them.
#pragma once

#include <warmjoint/friction.h>
#include <warmjoint/recording.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/figures/estimate_view.h"
#include "tools/figures/figure.h"

namespace warmjoint::figures {

using EstimateFigure = NamedFigure<EstimateView>;

/// All pictures: a new one is its own file and one line in estimate_figures.cc.
const std::vector<EstimateFigure>& EstimateFigures();

/// Verdict and parameters, data with fit, cold and warm close-ups, friction over speed, warm-up,
/// evidence of the residuals. Without a fit: what the data look like and why there is none.
Figure MakeFitPage(const FitView& view);

/// Position, velocity and torque over time, with the samples in colour that are kept for the fit.
Figure MakeLogFigure(const FitView& view);

/// Predicted over measured torque at the kept samples with the line of equality, and the residuals
/// over the predicted torque. With another recording than the one that was fitted, this shows how the
/// estimate carries over. Nothing without a fit.
std::optional<Figure> MakePredicted(const FitView& view);
/// The same of samples that the fit has not seen, the only ones that `view` keeps.
std::optional<Figure> MakeHeldOut(const FitView& view);

/// Parameters and RMSE of each iteration, with the final intervals, as in the paper's Fig. 8.
/// Nothing where the identifier did not iterate.
std::optional<Figure> MakeTrace(const Estimate& estimate, const std::string& what);

/// Torque with its envelope, and the friction level c(t) with what GuessThermal (25) reads off it:
/// levels cold and settled, 63 % time, gain and time constant, as in the paper's Fig. 4. truth: beside
/// the guess, where known. Nothing where there is no guess.
std::optional<Figure> MakeEnvelope(const std::string& what, const LogSamples& measurements,
                                   const Selection& selection, const std::optional<Thermal>& truth);

/// Torque over motor angle at the kept samples, by direction and speed, with medians in bins: ripple
/// of gear and motor, as in the paper's Fig. 7. Where the fit warms, its E is taken off. Nothing without a motor angle.
std::optional<Figure> MakeMotorAngle(const FitView& view);
/// What is left of the torque without the maps over motor angle, and the fitted maps over it, as in
/// Fig. 10. Nothing without a fitted map over motor angle.
std::optional<Figure> MakeMotorMap(const FitView& view);
/// The torque in time with and without these maps, as in Fig. 9.
std::optional<Figure> MakeMotorFit(const FitView& view);

/// sign(v) F over motor angle (or joint position, where the maps have that) and velocity, cold and
/// at the warmest of the recording, on one colour scale. Nothing without maps over an angle.
std::optional<Figure> MakeFrictionMap(const FitView& view);

/// An estimate under the name that it has in a picture of several.
using NamedEstimate = std::pair<std::string, EstimateView>;

/// Friction over velocity of each, cold, over the samples of the first, and E over time of those that
/// warm. Nothing where fewer than two have a friction and a recording.
std::optional<Figure> MakeOverlay(const std::vector<NamedEstimate>& estimates);

/// 0.3 t^2 - 0.5 seen with noise on a part of its axis, and what ridge regression makes of it with
/// plain (10)-(13) and with normalised (16) kernels, beyond the data too; below, both sets of
/// kernels. As in the paper's Fig. 3, of no recording.
Figure MakeKernels();

}  // namespace warmjoint::figures
