// A desktop OpenGL context without a display.
#pragma once

#include <memory>
#include <string>

namespace warmjoint::scene {

/// A current OpenGL 3.3 (or later) compatibility context of this thread; gone with the object.
class GlContext {
 public:
  using Procedure = void (*)();

  virtual ~GlContext() = default;
  /// Where the context comes from: "osmesa", "egl surfaceless" or "egl device".
  virtual std::string Name() const = 0;
  /// Address of a GL function, or nullptr.
  virtual Procedure Find(const char* function) const = 0;
  /// Makes it the thread's current context again.
  virtual void MakeCurrent() = 0;
  /// Lets MuJoCo's GL loader find this context: it takes the first of EGL and OSMesa among the
  /// symbols of the process, so that only one kind can serve it in a process.
  virtual void Publish() const = 0;
};

/// The first that this machine has of: OSMesa, EGL surfaceless, an EGL device. The environment
/// variable WARMJOINT_GL, osmesa or egl, forces one. None is linked: linking both libraries breaks
/// MuJoCo's loader. Throws BadInput naming the Debian package where there is none.
std::unique_ptr<GlContext> MakeGlContext();

/// One kind alone; nullptr where the machine does not have it.
std::unique_ptr<GlContext> MakeOsMesaContext();
std::unique_ptr<GlContext> MakeEglContext();

}  // namespace warmjoint::scene
