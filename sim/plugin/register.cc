#include "sim/plugin/register.h"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "sim/plugin/attributes.h"
#include "sim/plugin/friction_instance.h"
#include "sim/plugin/plugin_instances.h"

namespace warmjoint {
namespace {

// Read from the sources of 3.11 to 4.0; of a later engine read how its mj_initPlugin frees data after a plugin's -1.
static_assert(mjVERSION_HEADER >= 3011000 && mjVERSION_HEADER / 1000 <= 4000,
              "RefuseData frees data as the engines 3.11 to 4.0 do");

/// Refuses data from within a plugin's init. The data is freed as the engine frees it after a -1, with
/// what the instances before have made for it, which the engine leaves, and the refusal is given once,
/// as an error; that leaves by longjmp, so that no caller may have anything left to do.
void RefuseData(const mjModel* m, mjData* d, int instance, const char* refusal) {
  // what earlier instances hold of the data, then the data as the engine made it
  for (int before = 0; before < instance; ++before) {
    const mjpPlugin* plugin = mjp_getPluginAtSlot(m->plugin[before]);
    if (plugin->destroy) plugin->destroy(d, before);
  }
  mju_free(d->buffer);
  mju_free(d->arena);
  mju_free(d);
  mju_error("%s: %s", kFrictionPlugin, refusal);
}

/// Of a refusal, characters; the engine cuts errors off before that.
constexpr size_t kMostRefusal = 900;

FrictionInstance* InstanceOf(const mjData* d, int instance) {
  return reinterpret_cast<FrictionInstance*>(d->plugin_data[instance]);
}

/// Runs a callback. What it refuses, as far as it fits, stays for this thread; null where nothing was. An error that tells it
/// leaves by longjmp, so that nothing beside it may wait for its end.
template <typename Callback>
const char* RefusalOf(const Callback& callback) {
  static thread_local std::array<char, kMostRefusal> refusal;
  try {
    callback();
    return nullptr;
  } catch (const std::exception& refused) {
    *fmt::format_to_n(refusal.begin(), refusal.size() - 1, "{}", refused.what()).out = '\0';
    return refusal.data();
  }
}

/// Binds an instance to the data; refuses data that it cannot serve.
int Init(const mjModel* m, mjData* d, int instance) {
  const char* const refusal = RefusalOf([&] {
    auto made = std::make_unique<FrictionInstance>(m, instance);
    d->plugin_data[instance] = reinterpret_cast<uintptr_t>(made.release());
  });
  if (refusal) RefuseData(m, d, instance, refusal);
  return 0;
}

/// The numbers of plugin_state that an instance needs, whose attributes are read and checked.
int States(const mjModel* m, int instance) {
  int states = 0;
  const char* const refusal = RefusalOf([&] {
    PrepareInstance(m, instance);
    states = kFrictionEntries;
    if (DrivenByActuators(m, instance)) return;
    for (const ActingJoint& joint : FindJoints(m, instance)) {
      states += static_cast<int>(joint.prepared->friction.state().size());
    }
  });
  if (refusal) mju_error("%s: %s", kFrictionPlugin, refusal);
  return states;
}

/// Runs a callback; what it refuses in the middle of a run, where a model is another one than the
/// engine has checked, becomes a warning.
template <typename Callback>
void Guarded(const Callback& callback) {
  try {
    callback();
  } catch (const std::exception& refusal) {
    mju_warning("%s: %s", kFrictionPlugin, refusal.what());
  }
}

void Compute(const mjModel* m, mjData* d, int instance, int capability) {
  FrictionInstance& friction = *InstanceOf(d, instance);
  if (capability == mjPLUGIN_SENSOR) return friction.Sense(m, d);
  if (capability == mjPLUGIN_ACTUATOR && !friction.passive()) friction.ApplyActuators(m, d);
  if (capability == mjPLUGIN_PASSIVE && friction.passive()) {
    Guarded([&] { friction.StepPassive(m, d); });
  }
}

int SensorNumbers(const mjModel* m, int instance, int) {
  // States refuses what is wrong; until then one joint's numbers
  try {
    return SensorSize(m, instance);
  } catch (const std::exception&) {
    return kSensed;
  }
}

void Reset(const mjModel* m, mjtNum* state, void* data, int instance) {
  std::fill_n(state, m->plugin_statenum[instance], 0.0);
  if (!data) return;
  Guarded([&] { static_cast<FrictionInstance*>(data)->Reset(m, state); });
}

void ActDot(const mjModel* m, mjData* d, int instance) {
  if (InstanceOf(d, instance)->passive()) return;
  Guarded([&] { InstanceOf(d, instance)->StepActuators(m, d); });
}

void Destroy(mjData* d, int instance) {
  delete InstanceOf(d, instance);
  d->plugin_data[instance] = 0;
}

mjpPlugin MakePlugin() {
  static std::vector<const char*> names;
  for (const std::string& name : AttributeNames()) names.push_back(name.c_str());
  mjpPlugin plugin;
  mjp_defaultPlugin(&plugin);
  plugin.name = kFrictionPlugin;
  plugin.nattribute = static_cast<int>(names.size());
  plugin.attributes = names.data();
  plugin.capabilityflags = mjPLUGIN_ACTUATOR | mjPLUGIN_PASSIVE | mjPLUGIN_SENSOR;
  // at later stages the engine would work out velocities or forces of all bodies for it; sensors
  // are called at the first, and written by the step that follows
  plugin.needstage = mjSTAGE_POS;
  plugin.nsensordata = SensorNumbers;
  plugin.nstate = States;
  plugin.init = Init;
  plugin.destroy = Destroy;
  plugin.reset = Reset;
  plugin.actuator_act_dot = ActDot;
  plugin.compute = Compute;
  plugin.advance = [](const mjModel* m, mjData* d, int instance) {
    InstanceOf(d, instance)->Advance(m, d);
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

}  // namespace warmjoint
