#include "sim/plugin/register.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "models/foundation/bad_input.h"
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

/// Calls what follows with the instance that the data holds. The compiler steps data without any while it looks for the length
/// ranges of actuators: nothing is done there.
template <typename Call>
void WithInstance(const mjData* d, int instance, const Call& call) {
  if (FrictionInstance* friction = InstanceOf(d, instance)) call(*friction);
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
  WithInstance(d, instance, [&](FrictionInstance& friction) {
    if (capability == mjPLUGIN_SENSOR) return friction.Sense(m, d);
    if (capability == mjPLUGIN_ACTUATOR && !friction.passive()) friction.ApplyActuators(m, d);
    if (capability == mjPLUGIN_PASSIVE && friction.passive()) {
      Guarded([&] { friction.StepPassive(m, d); });
    }
  });
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
  WithInstance(d, instance, [&](FrictionInstance& friction) {
    if (friction.passive()) return;
    Guarded([&] { friction.StepActuators(m, d); });
  });
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
    WithInstance(d, instance, [&](FrictionInstance& friction) { friction.Advance(m, d); });
  };
  return plugin;
}

/// Whether two plugins read the same attributes, which tells versions apart.
bool SameAttributes(const mjpPlugin& one, const mjpPlugin& other) {
  return std::equal(one.attributes, one.attributes + one.nattribute, other.attributes,
                    other.attributes + other.nattribute,
                    [](const char* a, const char* b) { return std::string_view(a) == b; });
}

}  // namespace

void RegisterFrictionPlugin() {
  // a process may hold this code twice, as the library and in the program's own rooms: the first one serves all
  static const mjpPlugin own = MakePlugin();
  int slot = -1;
  const mjpPlugin* const known = mjp_getPlugin(kFrictionPlugin, &slot);
  if (!known) mjp_registerPlugin(&own);
  if (!known || SameAttributes(*known, own)) return;
  Dl_info library{};
  dladdr(reinterpret_cast<void*>(known->init), &library);
  Refuse({kFrictionPlugin}, "{} of another version is loaded already; load one of the two",
         library.dli_fname ? library.dli_fname : "a library");
}

}  // namespace warmjoint
