#include "sim/plugin/register.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <memory>
#include <vector>

#include "sim/plugin/attributes.h"
#include "sim/plugin/friction_instance.h"

namespace warmjoint::inline sim {
namespace {

FrictionInstance* InstanceOf(const mjData* d, int instance) {
  return reinterpret_cast<FrictionInstance*>(d->plugin_data[instance]);
}

/// Binds an instance to the data; a refusal becomes a warning and -1, so that nothing is thrown
/// through the engine.
int Init(const mjModel* m, mjData* d, int instance) {
  try {
    d->plugin_data[instance] =
        reinterpret_cast<uintptr_t>(std::make_unique<FrictionInstance>(m, instance).release());
    return 0;
  } catch (const std::exception& refusal) {
    mju_warning("%s: %s", kFrictionPlugin, refusal.what());
    return -1;
  }
}

void Destroy(mjData* d, int instance) {
  delete InstanceOf(d, instance);
  d->plugin_data[instance] = 0;
}

mjpPlugin MakePlugin() {
  static std::vector<const char*> names;
  for (const PluginAttribute& attribute : PluginAttributes()) {
    names.push_back(attribute.name.c_str());
  }

  mjpPlugin plugin;
  mjp_defaultPlugin(&plugin);
  plugin.name = kFrictionPlugin;
  plugin.nattribute = static_cast<int>(names.size());
  plugin.attributes = names.data();
  plugin.capabilityflags = mjPLUGIN_ACTUATOR;
  plugin.nstate = [](const mjModel*, int) -> int { return kFrictionReports; };
  plugin.init = Init;
  plugin.destroy = Destroy;
  plugin.reset = [](const mjModel*, mjtNum* reports, void*, int) {
    std::fill_n(reports, kFrictionReports, 0.0);
  };
  plugin.actuator_act_dot = [](const mjModel* m, mjData* d, int instance) {
    InstanceOf(d, instance)->Step(m, d);
  };
  plugin.compute = [](const mjModel* m, mjData* d, int instance, int) {
    InstanceOf(d, instance)->Apply(m, d);
  };
  return plugin;
}

}  // namespace

void RegisterFrictionPlugin() {
  static const int slot = [] {
    const mjpPlugin plugin = MakePlugin();
    return mjp_registerPlugin(&plugin);
  }();
  static_cast<void>(slot);
}

}  // namespace warmjoint::inline sim
