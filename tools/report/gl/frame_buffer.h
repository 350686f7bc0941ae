// Something to draw into: a multisampled frame buffer that can be read back.
#pragma once

#include <memory>

#include "tools/report/gl/context.h"
#include "tools/report/gl/image.h"

namespace warmjoint::report {

/// Colour buffer of 4 samples a pixel. The context must be current and outlive it.
class FrameBuffer {
 public:
  /// width, height: pixels. Throws BadInput where the driver cannot make one of that size.
  FrameBuffer(const GlContext& context, int width, int height);
  ~FrameBuffer();

  /// Directs drawing here and fills the buffer with a colour.
  void Clear(Rgb colour);
  /// What was drawn, resolved to one sample a pixel.
  Image Read();

 private:
  struct Gl;
  std::unique_ptr<Gl> gl_;
  int width_;
  int height_;
  unsigned frames_[2] = {0, 0};  // multisampled, resolved
  unsigned colours_[2] = {0, 0};
};

}  // namespace warmjoint::report
