// What a joint's torque owes to the angle of its motor, as in the paper's Figs. 7, 9 and 10.
#pragma once

#include <optional>

#include "tools/figures/figure.h"
#include "tools/figures/fit_view.h"

namespace warmjoint::figures {

/// Torque over motor angle at the kept samples, by direction and speed, with medians in bins: ripple
/// of gear and motor. Where the fit warms, its E is taken off. Nothing without a motor angle.
std::optional<Figure> MakeMotorAngle(const FitView& view);

/// What is left of the torque without the maps over motor angle, and the fitted maps over it, as in
/// Fig. 10. Nothing without a fitted map over motor angle.
std::optional<Figure> MakeMotorMap(const FitView& view);

/// The torque in time with and without these maps, as in Fig. 9.
std::optional<Figure> MakeMotorFit(const FitView& view);

}  // namespace warmjoint::figures
