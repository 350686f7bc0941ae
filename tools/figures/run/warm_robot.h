// The robot with its joint coloured by heat beside the friction that it changes.
#pragma once

#include <optional>
#include <vector>

#include "tools/figures/figure.h"
#include "tools/figures/run/simulation_figures.h"
#include "tools/scene/context.h"
#include "tools/scene/image.h"

namespace warmjoint::figures {

/// Whether the recording is of a robot, and warms.
bool HasWarmRobot(const SimulationView& view);

/// Colour of a heat, 0 (cold, blue) to 1 (hot, red).
scene::Rgb HeatColour(double fraction);

/// The robot of a simulated recording at some of its samples, which it fills the picture with; the link that the joint
/// carries has the colour of |E| (HeatColour, 0 to the largest of the recording). Images: one for each sample.
/// Nothing where the recording is of no robot, or nothing warms.
std::optional<std::vector<scene::Image>> RenderWarmRobot(const SimulationView& view,
                                                         scene::GlContext& context,
                                                         const std::vector<Eigen::Index>& samples,
                                                         int width, int height);

/// Cold and warmest robot, E, and the friction as it is and as it were without warming.
std::optional<Figure> MakeWarmRobot(const SimulationView& view, scene::GlContext& context);

}  // namespace warmjoint::figures
