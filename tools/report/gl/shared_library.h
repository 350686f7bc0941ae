// A shared library opened at run time.
#pragma once

#include <dlfcn.h>

#include <string>

namespace warmjoint::report {

/// Libraries stay open for the life of the process: drivers leave threads and exit handlers behind.
/// Symbols are global, because MuJoCo's GL loader looks for them among the symbols of the process.
class SharedLibrary {
 public:
  /// Opens the first of the named libraries that is there; see is_open().
  template <typename... Names>
  explicit SharedLibrary(Names... names) {
    for (const char* name : {names...}) {
      if (!handle_) handle_ = dlopen(name, RTLD_NOW | RTLD_GLOBAL);
    }
  }

  bool is_open() const { return handle_ != nullptr; }

  /// The function of that name, or nullptr.
  template <typename Function>
  Function Find(const char* name) const {
    return reinterpret_cast<Function>(dlsym(handle_, name));
  }

 private:
  void* handle_ = nullptr;
};

}  // namespace warmjoint::report
