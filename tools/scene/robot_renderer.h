// MuJoCo scenes as pictures, drawn in the same OpenGL context as everything else.
#pragma once

#include <mujoco/mujoco.h>

#include <array>
#include <memory>
#include <vector>

#include "tools/scene/context.h"
#include "tools/scene/image.h"

namespace warmjoint::scene {

/// From where a robot is looked at: from the front, the right, and above.
struct ViewFrom {
  double azimuth = 135;            // degrees
  double elevation = -20;          // degrees
  double distance = 2.1;           // times the model's extent
  std::array<double, 3> beside{};  // of the point that is looked at from the model's middle, m
};

/// What a robot covers of a picture: -1 is its left or lower edge, 1 its right or upper one.
struct Covered {
  double left = 1, right = -1, lower = 1, upper = -1;

  void Join(const Covered& other);
};

/// A place in a picture: pixels from its left and upper edge.
using Pixel = std::array<double, 2>;

/// Draws one model. The context must outlive it; model and data are the caller's.
class RobotRenderer {
 public:
  /// width, height: pixels of the pictures. Throws BadInput where the driver cannot draw them.
  RobotRenderer(GlContext& context, const mjModel& model, int width, int height);
  ~RobotRenderer();

  /// The model as `data` has it (after mj_forward), on a grey floor before a plain background.
  Image Draw(const mjData& data, const ViewFrom& from, Rgb background);

  /// Where a point of the world, m, is in the picture that Draw made last.
  Pixel PlaceOf(const std::array<double, 3>& point) const;

  /// The part of the picture that the model covers.
  Covered Box(const mjData& data, const ViewFrom& from);

  /// The same view moved and at such a distance that `covered` fills `share` of the picture.
  ViewFrom Closer(const ViewFrom& from, const Covered& covered, double share) const;

 private:
  struct Scene;

  /// Makes the scene current and fills it.
  void SetUp(const mjData& data, const ViewFrom& from);
  /// Adds the floor to the scene that SetUp filled.
  void AddFloor(const mjData& data);
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

}  // namespace warmjoint::scene
