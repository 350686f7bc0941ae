#include "sim/plugin/refused_data.h"

#include "sim/plugin/friction_reports.h"

namespace warmjoint::inline sim {
namespace {

void FreeData(const mjModel* m, mjData* d, int instance) {
  // what earlier instances hold of the data, then the data as the engine made it
  for (int before = 0; before < instance; ++before) {
    const mjpPlugin* plugin = mjp_getPluginAtSlot(m->plugin[before]);
    if (plugin->destroy) plugin->destroy(d, before);
  }
  mju_free(d->buffer);
  mju_free(d->arena);
  mju_free(d);
}

}  // namespace

int RefuseData(const mjModel* m, mjData* d, int instance, const char* refusal, int version) {
  // only a known engine's data can be freed from here
  if (!KnowsEngine(version)) {
    mju_warning("%s: %s", kFrictionPlugin, refusal);
    return -1;
  }
  FreeData(m, d, instance);
  mju_error("%s: %s", kFrictionPlugin, refusal);
  return -1;
}

}  // namespace warmjoint::inline sim
