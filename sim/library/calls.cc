// What is called in the shared library. MuJoCo: its entry, when the library is loaded. Python, by ctypes: text in, text out,
// both JSON.
//
// Each answer is an object; {"error": "..."} where the request is refused. It stays until the thread's next call.
#include <fmt/ranges.h>
#include <link.h>
#include <mujoco/mujoco.h>
#include <warmjoint/attach.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/node.h"
#include "models/foundation/serialize.h"
#include "models/friction/friction_json.h"
#include "sim/model/earlier_friction.h"
#include "sim/model/engine_warnings.h"
#include "sim/model/spec_elements.h"
#include "sim/plugin/bound_joints.h"
#include "sim/plugin/plugin_instances.h"
#include "sim/plugin/register.h"
#include "sim/plugin/stability.h"

namespace warmjoint {
namespace {

struct AttachRequest {
  std::string model;                        // its name, in messages
  std::vector<FrictionForJoint> frictions;  // each for the joints that a name or pattern means
  AttachOptions options;
  std::map<std::string, double> armatures;
  std::optional<std::string> integrator;
  std::map<std::string, std::map<std::string, std::string>> units;  // of estimates' parameters

  template <class A>
  void Serialize(A* a) {
    a->Field("model", &model);
    a->Field("frictions", &frictions, {.needed = "give a list"});
    a->Field("form", &options.form);
    a->Field("sensors", &options.sensors);
    a->Field("numbers", &options.numbers);
    a->Field("approximate", &options.approximate);
    a->Field("armatures", &armatures, {.unit = "kg.m^2"});
    a->Field("timestep", &options.timestep, {.unit = "s"});
    a->Field("integrator", &integrator);
    a->Field("stiffest_drive", &options.stiffest_drive, {.unit = "1"});
    a->Field("units", &units);
  }
};

Tree Attach(mjSpec& spec, const mjVFS* files, const char* text) {
  auto request = ReadAs<AttachRequest>(ParseJsonNode(text, "attach"));
  const std::vector<FrictionForJoint>& frictions = request.frictions;
  for (const FrictionForJoint& one : frictions) RefuseAmperes(one.friction, {one.joint});
  for (const auto& [joints, armature] : request.armatures) {
    request.options.armatures.push_back({joints, armature});
  }
  // choices by their names
  if (request.integrator == "auto") {
    request.options.integrator_choice = IntegratorChoice::automatic;
  } else if (request.integrator) {
    std::vector<std::string> names{"auto"};
    for (const auto& [name, unused] : Integrators()) names.push_back(name);
    const auto known = Integrators().find(*request.integrator);
    if (known == Integrators().end()) {
      Refuse({"integrator"}, "is '{}'; it must be one of {}", Excerpt(*request.integrator),
             fmt::join(names, ", "));
    }
    request.options.integrator = known->second;
  }
  for (const auto& [joint, units] : request.units) {
    const auto kind = KindOfUnits(units);
    if (kind) request.options.kinds.emplace(joint, *kind);
  }
  std::vector<std::string> warnings;
  const EngineWarnings taken([&](const std::string& warning) { warnings.push_back(warning); });
  // a copy goes first, so that what is refused leaves the model as it was
  const SpecPtr copy(mj_copySpec(&spec));
  if (!copy) Refuse({request.model}, "MuJoCo cannot copy it");
  AttachFriction(*copy, frictions, request.options, request.model, files);
  Attached attached = AttachFriction(spec, frictions, request.options, request.model, files);
  std::ranges::move(warnings, std::back_inserter(attached.notices));
  // each joint with the place of its friction in the request
  Tree joints = Tree::array();
  for (const std::string& name : attached.joints) {
    for (size_t i = 0; i < frictions.size(); ++i) {
      const std::vector<std::string> meant = MatchJoints(spec, frictions[i].joint, {});
      if (std::ranges::find(meant, name) == meant.end()) continue;
      joints.push_back({{"name", name}, {"given", i}});
    }
  }
  Tree springs = Tree::array();
  for (const NativeSpring& spring : attached.springs) {
    springs.push_back({{"name", spring.friction.joint},
                       {"stiffness", spring.stiffness},
                       {"initial_energy", spring.friction.initial_energy},
                       {"friction", FrictionToTree(spring.friction.friction)}});
  }
  return {{"joints", joints}, {"notices", attached.notices}, {"springs", springs}};
}

/// A number of a joint that may change at run time: in which field of the model it stands, where, and what it may be.
Tree NumberAt(const char* field, int place, const Bounds& bounds) {
  return {{"field", field},
          {"place", place},
          {"least", WriteValue(bounds.at_least)},
          {"above", WriteValue(bounds.above)},
          {"most", WriteValue(bounds.at_most)},
          {"words", bounds.Words()}};
}

/// Those of one joint by their names.
Tree NumbersOf(const BoundJoints& bound, size_t joint, const std::string& instance) {
  Tree numbers = Tree::object();
  for (const NumberArray& array : bound.numbers()) {
    if (!array.places[joint]) continue;
    const Bounds bounds =
        array.stage ? Bounds() : bound.joints()[joint].friction.NumberBounds(*array.places[joint]);
    numbers[array.name.substr(instance.size() + 1)] =
        NumberAt("numeric_data", array.address + static_cast<int>(joint), bounds);
  }
  const BoundJoint& of = bound.joints()[joint];
  if (of.viscous == Viscous::by_damping) {
    const size_t place = *of.friction.FindNumber(kViscousName);
    numbers[kViscousName] = NumberAt("dof_damping", of.dof, of.friction.NumberBounds(place));
  }
  return numbers;
}

/// Where the five numbers of a joint begin in sensordata; null where no sensor reads it.
Tree SensorOf(const mjModel* m, const BoundJoints& bound, size_t joint) {
  for (const BoundSensor& sensor : bound.sensors()) {
    const int address = m->sensor_adr[sensor.sensor];
    if (!sensor.joint) return address + kSensed * static_cast<int>(joint);
    if (*sensor.joint == joint) return address;
  }
  return nullptr;
}

/// The largest explicit slope of an instance's friction on a tree, in units of M/h.
double SteepestOn(int tree, const mjModel* m, const BoundJoints& bound) {
  double steepest = 0;
  for (const BoundJoint& joint : bound.joints()) {
    if (m->dof_treeid[joint.dof] != tree) continue;
    const double slope = ExplicitSlope(m, {joint.friction, joint.viscous});
    steepest = std::max(steepest, slope * m->opt.timestep / EffectiveInertia(m, joint.dof));
  }
  return steepest;
}

/// The joints of each instance, and where their numbers stand in the model's data.
Tree Describe(const mjModel* m) {
  int plugin = -1;
  mjp_getPlugin(kFrictionPlugin, &plugin);
  Tree joints = Tree::array();
  for (int instance = 0; instance < m->nplugin; ++instance) {
    if (m->plugin[instance] != plugin) continue;
    const BoundJoints bound(m, instance);
    const std::string name = NameIn(m, mjOBJ_PLUGIN, instance);
    const std::vector<ActingJoint> acting = FindJoints(m, instance);
    for (size_t i = 0; i < acting.size(); ++i) {
      std::vector<std::string> states;
      for (const StateMember& member : acting[i].prepared->friction.state()) {
        states.emplace_back(member.name);
      }
      const BoundJoint& of = bound.joints()[i];
      // of the only instance on its tree, whose joints know of each other
      const BristleShape shape =
          BristlesOf(1, of.drive, SteepestOn(m->dof_treeid[of.dof], m, bound));
      joints.push_back({{"name", NameIn(m, mjOBJ_JOINT, acting[i].joint)},
                        {"instance", name},
                        {"form", bound.passive() ? "passive" : "actuator"},
                        {"linear", m->jnt_type[acting[i].joint] == mjJNT_SLIDE},
                        {"state", of.state},
                        {"states", states},
                        {"report", m->plugin_stateadr[instance]},
                        {"sensor", SensorOf(m, bound, i)},
                        {"numbers", NumbersOf(bound, i, name)},
                        {"inertia", EffectiveInertia(m, of.dof)},
                        {"bristle", {{"stiffness", shape.stiffness}, {"damping", shape.damping}}},
                        {"instances", of.instances},
                        {"damping", of.viscous == Viscous::by_damping},
                        {"initial_energy", of.initial_energy},
                        {"friction", FrictionToTree(acting[i].prepared->description)}});
    }
  }
  return {{"joints", joints}};
}

/// Keeps an answer, or what was refused, for the thread that asks.
template <typename Call>
const char* Answer(const Call& call) {
  static thread_local std::string answer;
  try {
    answer = call().dump();
  } catch (const std::exception& refusal) {
    answer = Tree{{"error", refusal.what()}}.dump();
  }
  return answer.c_str();
}

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
}  // namespace warmjoint

/// Registers the plugin, unless the program runs another MuJoCo than the one that the library was
/// linked with and brought along: models of the program's would not find the plugin.
mjPLUGIN_LIB_INIT(warmjoint_friction) {
  warmjoint::Engines engines;
  // one MuJoCo, of the minor version whose structures this library knows; patches keep them
  dl_iterate_phdr(warmjoint::AddEngine, &engines);
  if (engines.count > 1 || mj_version() / 1000 != mjVERSION_HEADER / 1000) {
    std::fprintf(stderr,
                 "warmjoint.friction is built for MuJoCo %d.%d and cannot serve this program, "
                 "which holds %s; run it with that version of MuJoCo\n",
                 mjVERSION_HEADER / 1000000, mjVERSION_HEADER / 1000 % 1000, engines.paths.c_str());
    return;
  }
  try {
    warmjoint::RegisterFrictionPlugin();
  } catch (const warmjoint::BadInput& refused) {
    std::fprintf(stderr, "%s\n", refused.what());
  }
}

extern "C" {

/// Puts friction on joints of a spec (AttachFriction); a spec that is refused stays as it was.
/// files: meshes and textures in memory, or null. request: {model: name for messages, frictions: [{joint: name
/// or pattern, friction: as in a friction file, initial_energy: [E1, E2]}], form, sensors, numbers, approximate, armatures:
/// {joint: number}, timestep, integrator, stiffest_drive, units: {joint: {parameter: unit}} of estimates}. Answer: {joints: [{name, given: place in
/// frictions}], notices: [sentence], springs: of the native form [{name, stiffness, initial_energy, friction: as the spring holds it}]}.
[[gnu::visibility("default")]] const char* warmjoint_attach(mjSpec* spec, const mjVFS* files,
                                                            const char* request) {
  return warmjoint::Answer([&] { return warmjoint::Attach(*spec, files, request); });
}

/// Takes all friction of the plugin out of a spec. Answer: {}.
[[gnu::visibility("default")]] const char* warmjoint_remove(mjSpec* spec) {
  return warmjoint::Answer([&] {
    warmjoint::RemoveFriction(*spec);
    return warmjoint::Tree::object();
  });
}

/// The joints with friction of a model, in the order of instances and their joints. Answer: {joints: [{name,
/// instance, form, linear, state: first place in act (actuator) or plugin_state (passive), states: [name], report:
/// of the instance's entries in plugin_state, sensor: place in sensordata or null, numbers: {name: {field: numeric_data or
/// dof_damping, place there, least, above, most, words}}, inertia: effective at the reference pose, kg.m^2 or kg, bristle:
/// {stiffness, damping} (BristleShape) where one instance holds its tree, instances: on its tree, damping: whether the joint's damping is its viscous, initial_energy: [E1,
/// E2], friction}]}.
[[gnu::visibility("default")]] const char* warmjoint_joints(const mjModel* model) {
  return warmjoint::Answer([&] { return warmjoint::Describe(model); });
}
}
