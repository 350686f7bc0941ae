// OSMesa: Mesa's software rasteriser, drawing into memory.
#include <GL/osmesa.h>

#include <vector>

#include "tools/scene/context.h"

namespace warmjoint::scene {
namespace {

struct OsMesa {
  SharedLibrary library{"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"};
  decltype(&OSMesaCreateContextExt) create{};
  decltype(&OSMesaDestroyContext) destroy{};
  decltype(&OSMesaMakeCurrent) make_current{};

  bool Load() {
    return library.Find("OSMesaCreateContextExt", create) &&
           library.Find("OSMesaDestroyContext", destroy) &&
           library.Find("OSMesaMakeCurrent", make_current);
  }
};

class OsMesaContext : public GlContext {
 public:
  explicit OsMesaContext(const OsMesa& mesa) : mesa_(mesa) {
    context_ = mesa_.create(OSMESA_RGBA, 24, 8, 0, nullptr);
  }
  ~OsMesaContext() override {
    if (context_) mesa_.destroy(context_);
  }

  bool is_valid() const { return context_ != nullptr; }
  std::string Name() const override { return "osmesa"; }
  void Publish() const override { mesa_.library.Publish(); }
  void MakeCurrent() override {
    mesa_.make_current(context_, window_.data(), GL_UNSIGNED_BYTE, kSide, kSide);
  }

 private:
  static constexpr int kSide = 16;  // pixels; the window is not used: all drawing has own buffers

  OsMesa mesa_;
  OSMesaContext context_ = nullptr;
  std::vector<unsigned char> window_ = std::vector<unsigned char>(4 * kSide * kSide);
};

}  // namespace

std::unique_ptr<GlContext> MakeOsMesaContext() {
  OsMesa mesa;
  if (!mesa.Load()) return nullptr;
  auto context = std::make_unique<OsMesaContext>(mesa);
  if (!context->is_valid()) return nullptr;
  context->MakeCurrent();
  return context;
}

}  // namespace warmjoint::scene
