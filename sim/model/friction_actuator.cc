#include "sim/model/friction_actuator.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "models/foundation/excerpt.h"
#include "models/foundation/parse_number.h"
#include "models/friction/friction_json.h"
#include "models/friction/joint_friction.h"
#include "sim/model/spec_elements.h"
#include "sim/plugin/bound_joints.h"
#include "sim/plugin/plugin_instances.h"
#include "sim/plugin/register.h"
#include "sim/plugin/stability.h"

namespace warmjoint {
namespace {

/// A model of the section alone. MuJoCo's map of attributes belongs to the C++ library that it was
/// built with; made here from text, it is only passed on.
SpecPtr ParseSection(const std::string& section, const Place& place) {
  std::array<char, 1000> error{};
  const std::string text = "<mujoco>\n" + section + "</mujoco>\n";
  SpecPtr spec(mj_parseXMLString(text.c_str(), nullptr, error.data(), error.size()));
  if (!spec) Refuse(place, "the friction cannot be written as MJCF: {}", error.data());
  return spec;
}

/// A name that no element of that kind has: the stem, or the stem with a number behind.
std::string FreeName(mjSpec& spec, mjtObj type, const std::string& stem) {
  std::string name = stem;
  for (int i = 2; mjs_findElement(&spec, type, name.c_str()); ++i) {
    name = fmt::format("{}_{}", stem, i);
  }
  return name;
}

/// An instance of the plugin without a name and without attributes.
mjsPlugin* AddPlugin(mjSpec& spec) {
  RegisterFrictionPlugin();
  mjs_activatePlugin(&spec, kFrictionPlugin);
  mjsPlugin* instance = mjs_addPlugin(&spec);
  instance->active = 1;
  mjs_setString(instance->plugin_name, kFrictionPlugin);
  return instance;
}

void TakeAttributes(mjsPlugin& instance, const mjsPlugin& source) {
  mjs_setPluginAttributes(&instance, const_cast<void*>(mjs_getPluginAttributes(&source)));
}

/// The named instance that holds the friction of all joints.
mjsPlugin* AddInstance(mjSpec& spec, const std::vector<FrictionForJoint>& frictions,
                       const Place& place, const AttachOptions& options, Viscous viscous) {
  const std::string name = FreeName(spec, mjOBJ_PLUGIN, "friction");
  mjsPlugin* instance = AddPlugin(spec);
  const SpecPtr source = ParseSection(InstanceSection(name, frictions, options, viscous), place);
  TakeAttributes(*instance, *mjs_asPlugin(mjs_firstElement(source.get(), mjOBJ_PLUGIN)));
  // as the element's name it is found, as the instance's it is written
  mjs_setName(instance->element, name.c_str());
  mjs_setString(instance->name, name.c_str());
  return instance;
}

/// The nameless instance of one joint's actuator.
mjsPlugin* AddInlineInstance(mjSpec& spec, const FrictionForJoint& friction, const Place& place,
                             const AttachOptions& options, Viscous viscous) {
  mjsPlugin* instance = AddPlugin(spec);
  const SpecPtr source = ParseSection(FrictionSections(friction, options, viscous), place);
  TakeAttributes(*instance, mjs_asActuator(mjs_firstElement(source.get(), mjOBJ_ACTUATOR))->plugin);
  return instance;
}

/// Makes an element refer to the instance.
void Refer(mjsPlugin& element, const mjsPlugin& instance) {
  element.active = 1;
  element.element = instance.element;
  mjs_setString(element.plugin_name, kFrictionPlugin);
  mjs_setString(element.name, mjs_getString(instance.name));
}

void AddActuator(mjSpec& spec, const FrictionForJoint& friction, const mjsPlugin& instance) {
  // made of MuJoCo's own defaults, and only then put under the model's
  const SpecPtr blank(mj_makeSpec());
  mjsActuator* actuator = mjs_addActuator(&spec, mjs_getSpecDefault(blank.get()));
  mjs_setDefault(actuator->element, mjs_getSpecDefault(&spec));
  mjs_setName(actuator->element, FrictionActuatorOf(friction.joint).c_str());
  mjs_setString(actuator->target, friction.joint.c_str());
  actuator->trntype = mjTRN_JOINT;
  actuator->actdim = static_cast<int>(StateOf(friction.friction).size());
  Refer(actuator->plugin, instance);
}

/// Lets the first body in the tree that moves by one of the joints, and is no other plugin's, refer
/// to the instance: MuJoCo leaves an instance that nothing refers to behind where a body is put into
/// another model.
void ReferFromBody(mjSpec& spec, const std::vector<FrictionForJoint>& frictions,
                   const mjsPlugin& instance) {
  std::set<std::string> names;
  for (const FrictionForJoint& friction : frictions) names.insert(friction.joint);
  for (mjsElement* element : SpecElements(spec, mjOBJ_JOINT)) {
    mjsBody* body = mjs_getParent(element);
    if (!names.contains(NameOf(element)) || body->plugin.active) continue;
    return Refer(body->plugin, instance);
  }
}

/// A sensor for each joint, which reads its friction.
void AddSensors(mjSpec& spec, const std::vector<FrictionForJoint>& frictions,
                const mjsPlugin& instance) {
  for (const FrictionForJoint& friction : frictions) {
    mjsSensor* sensor = mjs_addSensor(&spec);
    const std::string name = FreeName(spec, mjOBJ_SENSOR, FrictionActuatorOf(friction.joint));
    mjs_setName(sensor->element, name.c_str());
    sensor->type = mjSENS_PLUGIN;
    sensor->objtype = mjOBJ_JOINT;
    mjs_setString(sensor->objname, friction.joint.c_str());
    // by name alone: a copy of the spec would keep a reference to this one's instance
    sensor->plugin.active = 1;
    mjs_setString(sensor->plugin.plugin_name, kFrictionPlugin);
    mjs_setString(sensor->plugin.name, mjs_getString(instance.name));
  }
}

/// A give that is small beside the backlash of gears, as a share of the largest: 5 mrad, 0.5 mm.
constexpr double kSmallGive = 0.1;

/// The number of two digits next to `value`, on the side that `round` takes.
double TwoDigits(double value, double (*round)(double)) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
  return *ParseNumber(fmt::format("{:.2g}", round(value / unit) * unit));
}

/// The option that gives a joint that inertia in place of the one that it has, kg.m^2 or kg.
std::string ArmatureFor(const mjModel* m, int joint, double inertia) {
  const int dof = m->jnt_dofadr[joint];
  const double armature = m->dof_armature[dof] + inertia - EffectiveInertia(m, dof);
  return fmt::format("--armature {}={}", mj_id2name(m, mjOBJ_JOINT, joint),
                     TwoDigits(armature, [](double x) { return std::ceil(x); }));
}

/// Runs a check, whose first refusal stays.
template <typename Check>
void KeepFirst(std::string& refusal, const Check& check) {
  try {
    check();
  } catch (const BadInput& refused) {
    if (refusal.empty()) refusal = refused.what();
  }
}

int JointOf(const mjModel* m, const FrictionForJoint& friction) {
  return mj_name2id(m, mjOBJ_JOINT, friction.joint.c_str());
}

/// Of each degree of freedom what the plugin adds, at most, N.m.s/rad or N.s/m.
std::vector<double> SlopesOf(const mjModel* m, const std::vector<FrictionForJoint>& frictions) {
  std::vector<double> slopes(static_cast<size_t>(m->nv), 0);
  for (const FrictionForJoint& friction : frictions) {
    const JointFriction of(friction.friction);
    slopes[static_cast<size_t>(m->jnt_dofadr[JointOf(m, friction)])] =
        SteppedFriction{of, Viscous::by_damping}.OwnSlope();
  }
  return slopes;
}

}  // namespace

void AddNumbers(mjSpec& spec, const std::vector<FrictionForJoint>& frictions,
                const std::string& instance, Viscous viscous) {
  // in the order in which the frictions bring them up
  std::vector<std::string> names;
  std::map<std::string, std::vector<double>> values;
  const auto set = [&](const std::string& name, size_t joint, double value) {
    const auto [array, is_new] = values.emplace(name, std::vector<double>(frictions.size()));
    if (is_new) names.push_back(name);
    array->second[joint] = value;
  };
  for (size_t i = 0; i < frictions.size(); ++i) {
    const auto& [joint, description, heat] = frictions[i];
    const JointFriction friction(description);
    for (const std::string& name : friction.NumberNames()) {
      // which is dof_damping of the model
      if (viscous == Viscous::by_damping && name == kViscousName) continue;
      set(name, i, friction.Number(*friction.FindNumber(name)));
    }
    const bool stages[] = {description.thermal.has_value(), description.second_thermal.has_value()};
    for (const size_t stage : {0, 1}) {
      if (stages[stage]) set(kInitialEnergies[stage], i, stage < heat.size() ? heat[stage] : 0);
    }
  }
  for (const std::string& name : names) {
    mjsNumeric* numeric = mjs_addNumeric(&spec);
    mjs_setName(numeric->element, fmt::format("{}/{}", instance, name).c_str());
    numeric->size = static_cast<int>(frictions.size());
    mjs_setDouble(numeric->data, values[name].data(), numeric->size);
  }
}

void CheckJoints(mjSpec& spec, const std::vector<FrictionForJoint>& frictions, const Place& place) {
  std::set<std::string> seen;
  for (const auto& [joint, friction, energy] : frictions) {
    CheckFriction(friction, place);
    const mjsJoint* target = FindJoint(spec, joint, place);
    if (target->type != mjJNT_HINGE && target->type != mjJNT_SLIDE) {
      Refuse(place, "joint '{}' is neither hinge nor slide; friction acts on these alone",
             Excerpt(joint));
    }
    if (!seen.insert(joint).second) {
      Refuse(place, "joint '{}' is given friction twice; give it one", Excerpt(joint));
    }
  }
}

void AddFriction(mjSpec& spec, const std::vector<FrictionForJoint>& frictions, const Place& place,
                 const AttachOptions& options, Viscous viscous) {
  if (frictions.empty()) return;
  CheckJoints(spec, frictions, place);
  // sensors and arrays need an instance with a name
  const bool passive = options.form == FrictionForm::passive;
  const bool alone = !passive && frictions.size() == 1 && !options.sensors && !options.numbers;
  const mjsPlugin* instance =
      alone ? AddInlineInstance(spec, frictions.front(), place, options, viscous)
            : AddInstance(spec, frictions, place, options, viscous);
  if (passive) {
    ReferFromBody(spec, frictions, *instance);
  } else {
    for (const FrictionForJoint& friction : frictions) AddActuator(spec, friction, *instance);
  }
  if (options.sensors) AddSensors(spec, frictions, *instance);
  if (options.numbers) AddNumbers(spec, frictions, mjs_getString(instance->name), viscous);
}

bool ClearOwnFriction(mjsJoint& joint) {
  const bool damped =
      std::ranges::any_of(joint.damping, [](double coefficient) { return coefficient != 0; });
  const bool any = damped || joint.frictionloss != 0;
  std::ranges::fill(joint.damping, 0.0);
  joint.frictionloss = 0;
  return any;
}

bool ClearPlasticSpring([[maybe_unused]] mjsJoint& joint) {
#if mjVERSION_HEADER >= 4000000
  const bool stiff =
      std::ranges::any_of(joint.stiffness, [](double coefficient) { return coefficient != 0; });
  if (!(joint.springyield > 0) || !stiff) return false;
  // its yield stays, so that keyframes keep the length of their plastic states
  std::ranges::fill(joint.stiffness, 0.0);
  return true;
#else
  return false;
#endif
}

void RefuseLightJoints(const mjModel* m, const std::vector<FrictionForJoint>& frictions,
                       const Place& place) {
  std::vector<std::string> armatures;
  std::string reason;
  double timestep = m->opt.timestep;
  // each joint that the plugin would refuse, with what would let it pass
  for (const FrictionForJoint& friction : frictions) {
    const int joint = JointOf(m, friction);
    const double inertia = EffectiveInertia(m, m->jnt_dofadr[joint]);
    double needed = inertia;
    const JointFriction of(friction.friction);
    for (const Asked& asked :
         AskedOf(m, joint, {of, Viscous::by_damping, inertia}, kLoneBristles)) {
      if (asked.inertia <= inertia) continue;
      if (reason.empty()) reason = fmt::format("{}: {}", JointName(m, joint), asked.why);
      needed = std::max(needed, asked.inertia);
      timestep = std::min(timestep, asked.timestep);
    }
    if (needed > inertia) armatures.push_back(ArmatureFor(m, joint, needed));
  }

  // one refusal for all of them
  if (armatures.empty()) return;
  Refuse(place,
         "{} of its joints cannot carry their friction; give {}, or --timestep {}. The first: {}",
         armatures.size(), fmt::join(armatures, " "),
         TwoDigits(timestep, [](double x) { return std::floor(x); }), reason);
}

std::vector<std::string> NoticesOfHolding(const mjModel* m,
                                          const std::vector<FrictionForJoint>& frictions,
                                          double stiffest_drive) {
  // what the step has to bear besides bristles
  std::vector<JointFriction> of;
  for (const FrictionForJoint& friction : frictions) of.emplace_back(friction.friction);
  const std::vector<double> slopes = SlopesOf(m, frictions);
  const std::vector<double> drives = StiffestDrives(m, m->opt.integrator, slopes);
  std::vector<std::string> notices, armatures;
  std::string shaking, damping;
  double most = 0;
  for (size_t i = 0; i < frictions.size(); ++i) {
    const int joint = JointOf(m, frictions[i]);
    const double inertia = EffectiveInertia(m, m->jnt_dofadr[joint]);
    const SteppedFriction stepped{of[i], Viscous::by_damping, inertia};
    const double drive = drives[m->dof_treeid[m->jnt_dofadr[joint]]];
    const Place place{JointName(m, joint)};
    KeepFirst(shaking, [&] { CheckDrive(m, joint, drive, slopes, place); });
    KeepFirst(damping, [&] { CheckDamping(m, joint, stepped, place); });
    // the give of the step's own bristle, as a share of the largest
    if (of[i].own_bristle()) continue;
    const BristleShape shape = BristlesOf(1, std::max(drive, stiffest_drive));
    const double asked = AskedOf(m, joint, stepped, shape)[1].inertia, share = asked / inertia;
    const bool slides = m->jnt_type[joint] == mjJNT_SLIDE;
    if (share > most) {
      notices = {
          fmt::format("joints give way elastically before they slide, most of all '{}' by "
                      "{:.2g} {}",
                      frictions[i].joint, share * (slides ? 5 : 50), slides ? "mm" : "mrad")};
    }
    most = std::max(most, share);
    if (share > kSmallGive) armatures.push_back(ArmatureFor(m, joint, asked / kSmallGive));
  }
  if (!armatures.empty()) {
    notices[0] += fmt::format("; for at most 5 mrad (0.5 mm) give {}", fmt::join(armatures, " "));
  }
  for (std::string* told : {&damping, &shaking}) {
    if (!told->empty()) notices.push_back(std::move(*told));
  }
  return notices;
}

bool NeedsImplicitfast(const mjModel* m, const std::vector<FrictionForJoint>& frictions) {
  const std::vector<double> slopes = SlopesOf(m, frictions);
  const std::vector<double> now = StiffestDrives(m, m->opt.integrator, slopes);
  const std::vector<double> then = StiffestDrives(m, mjINT_IMPLICITFAST, slopes);
  return std::ranges::any_of(frictions, [&](const FrictionForJoint& friction) {
    const auto tree = static_cast<size_t>(m->dof_treeid[m->jnt_dofadr[JointOf(m, friction)]]);
    return ShakesBeside(now[tree]) && !ShakesBeside(then[tree]);
  });
}

}  // namespace warmjoint
