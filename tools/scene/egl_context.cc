// EGL without a window: Mesa's surfaceless platform, else the first device that draws.
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <vector>

#include "tools/scene/context.h"

namespace warmjoint::scene {
namespace {

struct Egl {
  SharedLibrary library{"libEGL.so.1", "libEGL.so"};
  decltype(&eglGetProcAddress) find{};
  decltype(&eglInitialize) initialize{};
  decltype(&eglBindAPI) bind_api{};
  decltype(&eglChooseConfig) choose_config{};
  decltype(&eglCreateContext) create_context{};
  decltype(&eglDestroyContext) destroy_context{};
  decltype(&eglMakeCurrent) make_current{};
  PFNEGLGETPLATFORMDISPLAYEXTPROC platform_display{};
  PFNEGLQUERYDEVICESEXTPROC query_devices{};

  bool Load() {
    // functions that every EGL has
    const bool all =
        library.Find("eglGetProcAddress", find) && library.Find("eglInitialize", initialize) &&
        library.Find("eglBindAPI", bind_api) && library.Find("eglChooseConfig", choose_config) &&
        library.Find("eglCreateContext", create_context) &&
        library.Find("eglDestroyContext", destroy_context) &&
        library.Find("eglMakeCurrent", make_current);
    if (!all) return false;
    // extensions of the client: absent on some machines
    platform_display =
        reinterpret_cast<decltype(platform_display)>(find("eglGetPlatformDisplayEXT"));
    query_devices = reinterpret_cast<decltype(query_devices)>(find("eglQueryDevicesEXT"));
    return platform_display != nullptr;
  }
};

/// Displays belong to the process and are never terminated: other contexts may use the same, and
/// drivers that were unloaded would leave threads behind.
class EglContext : public GlContext {
 public:
  EglContext(const Egl& egl, EGLDisplay display, std::string name)
      : egl_(egl), display_(display), name_(std::move(name)) {}
  ~EglContext() override {
    if (context_ != EGL_NO_CONTEXT) {
      egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
      egl_.destroy_context(display_, context_);
    }
  }

  /// Whether a context came into being and is current.
  bool Open() {
    if (!egl_.initialize(display_, nullptr, nullptr) || !egl_.bind_api(EGL_OPENGL_API))
      return false;
    // any configuration that draws with OpenGL, without a window
    const std::array<EGLint, 5> wanted{EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                       EGL_NONE};
    EGLConfig config{};
    EGLint count = 0;
    egl_.choose_config(display_, wanted.data(), &config, 1, &count);
    if (count == 0) return false;
    context_ = egl_.create_context(display_, config, EGL_NO_CONTEXT, nullptr);
    return context_ != EGL_NO_CONTEXT &&
           egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE;
  }

  std::string Name() const override { return name_; }
  void Publish() const override { egl_.library.Publish(); }
  void MakeCurrent() override {
    egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
  }

 private:
  Egl egl_;
  EGLDisplay display_;
  std::string name_;
  EGLContext context_ = EGL_NO_CONTEXT;
};

std::unique_ptr<GlContext> Try(const Egl& egl, EGLDisplay display, std::string name) {
  if (display == EGL_NO_DISPLAY) return nullptr;
  auto context = std::make_unique<EglContext>(egl, display, std::move(name));
  return context->Open() ? std::move(context) : nullptr;
}

}  // namespace

std::unique_ptr<GlContext> MakeEglContext() {
  Egl egl;
  if (!egl.Load()) return nullptr;

  // a display that needs no device goes first
  const EGLDisplay surfaceless =
      egl.platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (auto context = Try(egl, surfaceless, "egl surfaceless")) return context;

  // devices in the order of the driver list
  if (!egl.query_devices) return nullptr;
  EGLint count = 0;
  egl.query_devices(0, nullptr, &count);
  std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
  egl.query_devices(count, devices.data(), &count);
  for (EGLDeviceEXT device : devices) {
    const EGLDisplay display = egl.platform_display(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
    if (auto context = Try(egl, display, "egl device")) return context;
  }
  return nullptr;
}

}  // namespace warmjoint::scene
