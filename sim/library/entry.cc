// Entry of the shared library: MuJoCo calls it when the library is loaded.
#include <link.h>
#include <mujoco/mujoco.h>

#include <cstdio>
#include <string>
#include <string_view>

#include "sim/plugin/register.h"

namespace {

/// The paths of MuJoCo's libraries in this process.
struct Engines {
  int count = 0;
  std::string paths;
};

int AddEngine(dl_phdr_info* library, size_t, void* data) {
  const std::string_view path = library->dlpi_name;
  const size_t name = path.rfind('/') == std::string_view::npos ? 0 : path.rfind('/') + 1;
  if (!path.substr(name).starts_with("libmujoco.so")) return 0;
  auto& engines = *static_cast<Engines*>(data);
  engines.paths += (engines.count++ == 0 ? "" : ", ") + std::string(path);
  return 0;
}

}  // namespace

/// Registers the plugin, unless the program runs another MuJoCo than the one that the library was
/// linked with and brought along: models of the program's would not find the plugin.
mjPLUGIN_LIB_INIT(warmjoint_friction) {
  Engines engines;
  // one MuJoCo, of the version whose structures this library knows
  dl_iterate_phdr(AddEngine, &engines);
  if (engines.count > 1 || mj_version() != mjVERSION_HEADER) {
    std::fprintf(stderr,
                 "warmjoint.friction is built for MuJoCo %d.%d.%d and cannot serve this program, "
                 "which holds %s; run it with that version of MuJoCo\n",
                 mjVERSION_HEADER / 1000000, mjVERSION_HEADER / 1000 % 1000,
                 mjVERSION_HEADER % 1000, engines.paths.c_str());
    return;
  }
  warmjoint::RegisterFrictionPlugin();
}
