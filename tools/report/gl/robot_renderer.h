// MuJoCo scenes as pictures, drawn in the same OpenGL context as everything else.
#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <vector>

#include "tools/report/gl/context.h"
#include "tools/report/gl/image.h"

namespace warmjoint::report {

/// From where a robot is looked at: its whole extent from the front, the right, and above.
struct ViewFrom {
  double azimuth = 135;    // degrees
  double elevation = -20;  // degrees
  double distance = 2.1;   // times the model's extent
};

/// Draws one model. The context must outlive it; model and data are the caller's.
class RobotRenderer {
 public:
  /// width, height: pixels of the pictures. Throws BadInput where the driver cannot draw them.
  RobotRenderer(GlContext& context, const mjModel& model, int width, int height);
  ~RobotRenderer();

  /// The model as `data` has it (after mj_forward), before a plain background.
  Image Draw(const mjData& data, const ViewFrom& from, Rgb background);

  /// How far from its middle the model reaches in the picture: 1 touches an edge, 0 is nothing.
  double Reach(const mjData& data, const ViewFrom& from);

 private:
  struct Scene;

  /// Makes the scene current and fills it.
  void SetUp(const mjData& data, const ViewFrom& from);
  /// Pixels of the scene, RGB, rows from the bottom: colours, or the numbers of the geoms (0:
  /// none).
  enum class Paint { colours, geoms };
  std::vector<unsigned char> Render(Paint paint);

  std::unique_ptr<Scene> scene_;
  GlContext& context_;
  const mjModel& model_;
  int width_;
  int height_;
};

}  // namespace warmjoint::report
