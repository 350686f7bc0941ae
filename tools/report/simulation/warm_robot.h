// The robot with its joint coloured by heat beside the torque that it costs.
#pragma once

#include <optional>
#include <vector>

#include "tools/report/draw/figure.h"
#include "tools/report/gl/context.h"
#include "tools/report/simulation/simulation_view.h"

namespace warmjoint::report {

/// Whether the recording is of a robot, and warms.
bool HasWarmRobot(const SimulationView& view);

/// The robot of a simulated recording at some of its samples; the link that the joint carries has
/// the colour of |E| (HeatColour, 0 to the largest of the recording). Images: one for each sample.
/// Nothing where the recording is of no robot, or nothing warms.
std::optional<std::vector<Image>> RenderWarmRobot(const SimulationView& view, GlContext& context,
                                                  const std::vector<Eigen::Index>& samples,
                                                  int width, int height, const Theme& theme);

/// Still: cold and warmest robot, the torque as it is and as it were without warming, E.
std::optional<Figure> MakeWarmRobot(const SimulationView& view, GlContext& context);

}  // namespace warmjoint::report
