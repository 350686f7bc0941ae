#include "tools/scene/context.h"

#include <cstdlib>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"

namespace warmjoint::scene {

std::unique_ptr<GlContext> MakeGlContext() {
  const char* variable = std::getenv("WARMJOINT_GL");
  const std::string forced = variable ? variable : "";
  const Place place{"environment variable WARMJOINT_GL"};

  // a way that was asked for is the only one tried
  if (forced == "osmesa") {
    if (auto context = MakeOsMesaContext()) return context;
    Refuse(place, "no OSMesa here: install the Debian package libosmesa6, or unset the variable");
  }
  if (forced == "egl") {
    if (auto context = MakeEglContext()) return context;
    Refuse(place,
           "no EGL here that draws without a display: install the Debian packages libegl1 and "
           "libegl-mesa0, or unset the variable");
  }
  // any other word is a mistake
  if (!forced.empty()) {
    Refuse(place, "unknown value '{}'{}", Excerpt(forced), Suggestion(forced, {"osmesa", "egl"}));
  }

  // drawing in software goes first
  if (auto context = MakeOsMesaContext()) return context;
  if (auto context = MakeEglContext()) return context;
  Refuse({},
         "pictures need OpenGL without a display, and this machine has none: install the "
         "Debian package libosmesa6 (or libegl1 with libegl-mesa0)");
}

}  // namespace warmjoint::scene
