// A robot whose joint warms, as pixels.
#pragma once

#include <vector>

#include "tools/scene/context.h"
#include "tools/scene/image.h"
#include "tools/scene/robot_renderer.h"
#include "tools/shown/run/simulation_view.h"

namespace warmjoint::shown {

/// Whether the recording is of a robot, and warms.
bool HasWarmRobot(const SimulationView& view);

/// Colours of heat from cold to hot, told apart by colour-blind readers and in grey.
const std::vector<scene::Rgb>& HeatColours();

/// Between them: 0 is cold, 1 hot.
scene::Rgb HeatColour(double fraction);

/// The robot at one sample, and where its joint is in the picture.
struct RobotPicture {
  scene::Image image;
  std::vector<scene::Pixel> axis;  // the two ends of the joint's axis
  std::vector<scene::Pixel>
      arc;  // about it, or along it of a linear joint, the way the joint moves
};

/// The robot of a simulated recording at some of its samples, which it fills the picture with; the link that the joint
/// carries has the colour of |E| (HeatColour, 0 to the largest of the recording). The recording must have a warm robot.
std::vector<RobotPicture> RenderWarmRobot(const SimulationView& view, scene::GlContext& context,
                                          const std::vector<Eigen::Index>& samples, int width,
                                          int height);

/// {robot, joint, colours[], pictures[{time, energy, pixels, axis, arc}]}: cold and at its warmest. pixels: [height x width], red 2^16 +
/// green 2^8 + blue.
Tree WarmRobotFacts(const SimulationView& view, scene::GlContext& context, ShownData& data);

}  // namespace warmjoint::shown
