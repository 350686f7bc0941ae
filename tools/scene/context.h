// A desktop OpenGL context without a display, from a library that is opened at run time.
#pragma once

#include <dlfcn.h>

#include <memory>
#include <string>

namespace warmjoint::scene {

/// Libraries stay open for the life of the process: drivers leave threads and exit handlers behind.
class SharedLibrary {
 public:
  /// Opens the first of the named libraries that is there.
  template <typename... Names>
  explicit SharedLibrary(Names... names) {
    for (const char* name : {names...}) {
      if (handle_) break;
      handle_ = dlopen(name, RTLD_NOW | RTLD_LOCAL);
      name_ = name;
    }
  }

  /// Puts the library's symbols among those of the process, for loaders that look there.
  void Publish() const { dlopen(name_, RTLD_NOW | RTLD_GLOBAL | RTLD_NOLOAD); }

  /// Looks a function up; false where the library is not open or lacks it.
  template <typename Function>
  bool Find(const char* name, Function& function) const {
    function = handle_ ? reinterpret_cast<Function>(dlsym(handle_, name)) : nullptr;
    return function != nullptr;
  }

 private:
  void* handle_ = nullptr;
  const char* name_ = nullptr;
};

/// A current OpenGL 3.3 (or later) compatibility context of this thread; gone with the object.
class GlContext {
 public:
  virtual ~GlContext() = default;
  /// Where the context comes from: "osmesa", "egl surfaceless" or "egl device".
  virtual std::string Name() const = 0;
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
