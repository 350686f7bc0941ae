#include "tools/report/gl/frame_buffer.h"

// types alone: every function comes from the context
#include <GL/gl.h>
#include <GL/glext.h>

#include <cassert>
#include <cstring>

#include "models/foundation/bad_input.h"

namespace warmjoint::report {

struct FrameBuffer::Gl {
  explicit Gl(const GlContext& context) {
    Load(context, "glGenFramebuffers", gen_frames);
    Load(context, "glDeleteFramebuffers", delete_frames);
    Load(context, "glBindFramebuffer", bind_frame);
    Load(context, "glCheckFramebufferStatus", check_frame);
    Load(context, "glBlitFramebuffer", blit);
    Load(context, "glGenRenderbuffers", gen_buffers);
    Load(context, "glDeleteRenderbuffers", delete_buffers);
    Load(context, "glBindRenderbuffer", bind_buffer);
    Load(context, "glRenderbufferStorageMultisample", storage);
    Load(context, "glFramebufferRenderbuffer", attach);
    Load(context, "glClearColor", clear_color);
    Load(context, "glClear", clear);
    Load(context, "glViewport", viewport);
    Load(context, "glDisable", disable);
    Load(context, "glPixelStorei", pixel_store);
    Load(context, "glReadPixels", read_pixels);
  }

  template <typename Function>
  static void Load(const GlContext& context, const char* name, Function& function) {
    function = reinterpret_cast<Function>(context.Find(name));
    if (!function) Refuse({}, "OpenGL ({}) lacks {}: pictures need 3.3", context.Name(), name);
  }

  PFNGLGENFRAMEBUFFERSPROC gen_frames{};
  PFNGLDELETEFRAMEBUFFERSPROC delete_frames{};
  PFNGLBINDFRAMEBUFFERPROC bind_frame{};
  PFNGLCHECKFRAMEBUFFERSTATUSPROC check_frame{};
  PFNGLBLITFRAMEBUFFERPROC blit{};
  PFNGLGENRENDERBUFFERSPROC gen_buffers{};
  PFNGLDELETERENDERBUFFERSPROC delete_buffers{};
  PFNGLBINDRENDERBUFFERPROC bind_buffer{};
  PFNGLRENDERBUFFERSTORAGEMULTISAMPLEPROC storage{};
  PFNGLFRAMEBUFFERRENDERBUFFERPROC attach{};
  decltype(&glClearColor) clear_color{};
  decltype(&glClear) clear{};
  decltype(&glViewport) viewport{};
  decltype(&glDisable) disable{};
  decltype(&glPixelStorei) pixel_store{};
  decltype(&glReadPixels) read_pixels{};
};

FrameBuffer::FrameBuffer(const GlContext& context, int width, int height)
    : gl_(std::make_unique<Gl>(context)), width_(width), height_(height) {
  constexpr int kSamples[2] = {4, 0};
  gl_->gen_frames(2, frames_);
  gl_->gen_buffers(2, colours_);
  for (int i = 0; i < 2; ++i) {
    gl_->bind_buffer(GL_RENDERBUFFER, colours_[i]);
    gl_->storage(GL_RENDERBUFFER, kSamples[i], GL_RGBA8, width, height);
    gl_->bind_frame(GL_FRAMEBUFFER, frames_[i]);
    gl_->attach(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colours_[i]);
    if (gl_->check_frame(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
      Refuse({}, "OpenGL ({}) cannot draw pictures of {} x {} pixels: ask for a smaller one",
             context.Name(), width, height);
    }
  }
}

FrameBuffer::~FrameBuffer() {
  gl_->bind_frame(GL_FRAMEBUFFER, 0);
  gl_->delete_frames(2, frames_);
  gl_->delete_buffers(2, colours_);
}

void FrameBuffer::Clear(Rgb colour) {
  const auto part = [](std::uint8_t value) { return static_cast<float>(value) / 255.0f; };
  gl_->bind_frame(GL_FRAMEBUFFER, frames_[0]);
  gl_->viewport(0, 0, width_, height_);
  gl_->disable(GL_SCISSOR_TEST);
  gl_->clear_color(part(colour.red), part(colour.green), part(colour.blue), 1);
  gl_->clear(GL_COLOR_BUFFER_BIT);
}

Image FrameBuffer::Read() {
  gl_->bind_frame(GL_READ_FRAMEBUFFER, frames_[0]);
  gl_->bind_frame(GL_DRAW_FRAMEBUFFER, frames_[1]);
  gl_->blit(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  gl_->bind_frame(GL_FRAMEBUFFER, frames_[1]);
  gl_->pixel_store(GL_PACK_ALIGNMENT, 1);
  const std::size_t row = std::size_t{3} * width_;
  std::vector<std::uint8_t> upward(row * height_);
  gl_->read_pixels(0, 0, width_, height_, GL_RGB, GL_UNSIGNED_BYTE, upward.data());

  // GL counts rows from the bottom
  Image image{width_, height_, std::vector<std::uint8_t>(upward.size())};
  for (int y = 0; y < height_; ++y) {
    std::memcpy(&image.pixels[row * y], &upward[row * (height_ - 1 - y)], row);
  }
  return image;
}

}  // namespace warmjoint::report
