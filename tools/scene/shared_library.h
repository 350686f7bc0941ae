// A shared library opened at run time.
#pragma once

#include <dlfcn.h>

#include <string>

namespace warmjoint::scene {

/// Libraries stay open for the life of the process: drivers leave threads and exit handlers behind.
class SharedLibrary {
 public:
  /// Opens the first of the named libraries that is there; see is_open().
  template <typename... Names>
  explicit SharedLibrary(Names... names) {
    for (const char* name : {names...}) {
      if (handle_) break;
      handle_ = dlopen(name, RTLD_NOW | RTLD_LOCAL);
      name_ = name;
    }
  }

  bool is_open() const { return handle_ != nullptr; }

  /// Puts the library's symbols among those of the process, for loaders that look there.
  void Publish() const { dlopen(name_, RTLD_NOW | RTLD_GLOBAL | RTLD_NOLOAD); }

  /// The function of that name, or nullptr.
  template <typename Function>
  Function Find(const char* name) const {
    return reinterpret_cast<Function>(dlsym(handle_, name));
  }

 private:
  void* handle_ = nullptr;
  const char* name_ = nullptr;
};

}  // namespace warmjoint::scene
