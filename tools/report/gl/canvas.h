// Off-screen drawing with Dear ImGui and ImPlot.
#pragma once

#include <functional>
#include <memory>

#include "tools/report/gl/context.h"
#include "tools/report/gl/image.h"

struct ImFont;

namespace warmjoint::report {

/// What the drawing function works with; coordinates are points, x to the right, y downwards.
struct Brush {
  ImFont* regular;
  ImFont* bold;
};

/// Keeps one GL context; draws any number of pictures. One thread at a time; one for each process
/// is enough. The same drawing gives the same bytes, whatever was drawn before it.
class Canvas {
 public:
  /// Throws BadInput where the machine has no OpenGL (MakeGlContext).
  Canvas() : Canvas(MakeGlContext()) {}
  explicit Canvas(std::unique_ptr<GlContext> context);
  ~Canvas();

  /// Calls `draw` inside a borderless window of width x height points, for every frame that ImGui
  /// needs until all is in place, and returns the last: 2 pixels a point, drawn at 4 (and 4 samples
  /// each), shrunk.
  Image Draw(int width, int height, Rgb background, const std::function<void(const Brush&)>& draw);

  GlContext& context() { return *context_; }

  static constexpr int kPixelsPerPoint = 2;

 private:
  std::unique_ptr<GlContext> context_;
};

}  // namespace warmjoint::report
