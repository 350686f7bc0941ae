// What friction costs in a step of MuJoCo: robots with a motor on each joint, one thread, ratios of one
// run to the robot without friction.
//
//   serial arm: six hinges in a row, damping 2 N.m.s/rad, steps of 2 ms
//   industrial arm: models/robots/irb140_like, the same damping, steps of 1 ms
//   humanoid: a free base with 23 hinges on two legs, two arms and a head, the same damping, steps of 2 ms
//
// "sliding" is under drives that keep the speed of all joints, "turning" under torques that swing so widely that now the
// one, now the other joint comes to a stop, "mixed" under constant torques after a push, with a low level, so that joints
// fall, swing and stop, "some held" with heavy joints of which two (the humanoid: three) stay held while the others coast, and
// "held" at rest under gravity (the humanoid: without).
// Each round runs all variants in turn; the ratio is the median over rounds of the thread's time to that
// of the arm without friction in the same round, so that a busy machine disturbs both alike.
// "idle plugin" is one that does nothing: what the engine itself charges for a plugin in that form.
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "sim/model/friction_actuator.h"
#include "sim/model/load_model.h"
#include "sim/model/spec_elements.h"
#include "tests/support/folders.h"

namespace warmjoint {
namespace {

constexpr int kSteps = 400;     // of a round
constexpr double kDamping = 2;  // N.m.s/rad, of every joint
constexpr int kNoslip[] = {0, 3};

using Change = std::function<void(mjSpec&, const std::vector<std::string>&)>;

enum class Arm { serial, industrial, humanoid };
enum class Drive { sliding, turning, mixed, some_held, held };

/// A robot in a regime.
struct Regime {
  Arm arm;
  mjtIntegrator integrator;
  Drive drive;

  /// Friction's level on every joint, N.m: what holds the robot at rest under gravity, or lets it swing.
  double level() const {
    if (arm == Arm::humanoid) return 5;
    if (drive == Drive::mixed) return 3;
    return arm == Arm::serial ? 30 : 80;
  }
};

/// Six hinges in a row, with the axes of an industrial arm.
SpecPtr SerialArm() {
  std::string bodies, ends;
  const char* axes[] = {"0 0 1", "0 1 0", "0 1 0", "1 0 0", "0 1 0", "1 0 0"};
  for (int i = 0; i < 6; ++i) {
    bodies += fmt::format(
        R"(<body pos="{} 0 0"><joint name="j{}" axis="{}" armature="0.1"/>
           <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.04" mass="{}"/>)",
        i == 0 ? 0 : 0.2, i, axes[i], 3 - 0.4 * i);
    ends += "</body>";
  }
  char error[1000] = "";
  SpecPtr spec(
      mj_parseXMLString(("<mujoco><worldbody>" + bodies + ends + "</worldbody></mujoco>").c_str(),
                        nullptr, error, sizeof(error)));
  if (!spec) Refuse({"bench"}, "{}", error);
  spec->option.timestep = 0.002;
  return spec;
}

/// Hinges in a row below a body, each on a link of its own.
std::string Limb(const std::string& name, const std::string& place, int joints) {
  std::string bodies, ends;
  const char* axes[] = {"0 0 1", "1 0 0", "0 1 0"};
  for (int i = 0; i < joints; ++i) {
    bodies += fmt::format(
        R"(<body pos="{}"><joint name="{}{}" axis="{}" armature="0.05"/>
           <geom type="capsule" fromto="0 0 0 0 0 -0.12" size="0.04" mass="{}"/>)",
        i == 0 ? place : "0 0 -0.12", name, i, axes[i % 3], 2 - 0.25 * i);
    ends += "</body>";
  }
  return bodies + ends;
}

SpecPtr Humanoid() {
  const std::string text =
      R"(<mujoco><option gravity="0 0 0"/><worldbody><body><freejoint name="base"/>
         <geom type="box" size="0.1 0.15 0.3" mass="15"/>)" +
      Limb("left_leg", "0 0.1 -0.3", 6) + Limb("right_leg", "0 -0.1 -0.3", 6) +
      Limb("left_arm", "0 0.2 0.3", 5) + Limb("right_arm", "0 -0.2 0.3", 5) +
      Limb("head", "0 0 0.3", 1) + "</body></worldbody></mujoco>";
  char error[1000] = "";
  SpecPtr spec(mj_parseXMLString(text.c_str(), nullptr, error, sizeof(error)));
  if (!spec) Refuse({"bench"}, "{}", error);
  spec->option.timestep = 0.002;
  return spec;
}

SpecPtr IndustrialArm() {
  const auto file = test::SourceFolder() / "models/robots/irb140_like/irb140_like.xml";
  SpecPtr spec = std::move(ParseModel(file).spec);
  for (const mjtObj type : {mjOBJ_KEY, mjOBJ_SENSOR, mjOBJ_ACTUATOR}) {
    for (mjsElement* element : SpecElements(*spec, type)) mjs_delete(spec.get(), element);
  }
  spec->option.timestep = 0.001;
  return spec;
}

mjsActuator* AddActuator(mjSpec& spec, const std::string& joint) {
  mjsActuator* actuator = mjs_addActuator(&spec, nullptr);
  mjs_setString(actuator->target, joint.c_str());
  actuator->trntype = mjTRN_JOINT;
  return actuator;
}

/// Its hinges with motors and no contacts, changed, compiled.
ModelPtr MakeArm(const Regime& regime, int noslip, const Change& change) {
  const SpecPtr spec = regime.arm == Arm::serial       ? SerialArm()
                       : regime.arm == Arm::industrial ? IndustrialArm()
                                                       : Humanoid();
  std::vector<std::string> joints;
  for (mjsElement* element : SpecElements(*spec, mjOBJ_JOINT)) {
    mjsJoint* joint = mjs_asJoint(element);
    if (joint->type != mjJNT_HINGE) continue;
    joints.push_back(mjs_getString(mjs_getName(element)));
    if (regime.drive == Drive::some_held) joint->armature = 200;
    ClearOwnFriction(*joint);
    joint->damping[0] = kDamping;
    joint->limited = mjLIMITED_FALSE;
    joint->actfrclimited = mjLIMITED_FALSE;
  }
  spec->option.integrator = regime.integrator;
  spec->option.noslip_iterations = noslip;
  spec->option.disableflags |= mjDSBL_CONTACT;
  for (const std::string& joint : joints) mjs_setToMotor(AddActuator(*spec, joint));
  change(*spec, joints);
  return CompileModel(*spec, {"bench"});
}

Friction Simple(double level) {
  Friction friction;
  friction.law = "asymmetric";
  friction.parameters = {
      {"viscous", 0.5}, {"coulomb_positive", level}, {"coulomb_negative", 1.1 * level}};
  friction.thermal = Thermal{-0.001, 300};
  friction.gear = 100;
  return friction;
}

/// The simple one with Stribeck's level and a map of 36 motor angles times 6 speeds.
Friction Full(double level) {
  Friction friction = Simple(level);
  friction.law = "stribeck";
  friction.parameters = {{"viscous", 0.5},
                         {"coulomb", level},
                         {"static", 1.3 * level},
                         {"stribeck_velocity", 0.05},
                         {"stribeck_exponent", 2}};
  FrictionMap map{{{MapQuantity::motor_position, CircleAxis(6.283185307179586, 36)},
                   {MapQuantity::velocity, SpeedAxis(0.1, 2, 3)}},
                  KernelKind::normalised,
                  {},
                  MapFactor::direction};
  for (size_t i = 0; i < map.size(); ++i) {
    map.weights.push_back(0.2 * std::sin(static_cast<double>(i)));
  }
  friction.maps = {map};
  return friction;
}

Change WithFriction(const Friction& friction, FrictionForm form) {
  return [friction, form](mjSpec& spec, const std::vector<std::string>& joints) {
    std::vector<FrictionForJoint> frictions;
    for (const std::string& joint : joints) frictions.push_back({joint, friction});
    AddFriction(spec, frictions, {"bench"}, {.form = form});
  };
}

/// An instance of a plugin that does nothing, with as many states as six joints have.
mjsPlugin* AddIdlePlugin(mjSpec& spec) {
  constexpr char name[] = "warmjoint.idle";
  static const int slot = [] {
    mjpPlugin plugin;
    mjp_defaultPlugin(&plugin);
    plugin.name = name;
    plugin.capabilityflags = mjPLUGIN_ACTUATOR | mjPLUGIN_PASSIVE | mjPLUGIN_SENSOR;
    plugin.needstage = mjSTAGE_POS;
    plugin.nstate = [](const mjModel*, int) { return 15; };
    plugin.nsensordata = [](const mjModel*, int, int) { return 0; };
    plugin.actuator_act_dot = [](const mjModel*, mjData*, int) {};
    plugin.compute = [](const mjModel*, mjData*, int, int) {};
    plugin.advance = [](const mjModel*, mjData*, int) {};
    return mjp_registerPlugin(&plugin);
  }();
  static_cast<void>(slot);
  mjs_activatePlugin(&spec, name);
  mjsPlugin* instance = mjs_addPlugin(&spec);
  instance->active = 1;
  mjs_setString(instance->plugin_name, name);
  mjs_setName(instance->element, "idle");
  mjs_setString(instance->name, "idle");
  return instance;
}

void WithIdlePassive(mjSpec& spec, const std::vector<std::string>&) { AddIdlePlugin(spec); }

void WithIdleActuators(mjSpec& spec, const std::vector<std::string>& joints) {
  const mjsPlugin* instance = AddIdlePlugin(spec);
  for (const std::string& joint : joints) {
    mjsActuator* actuator = AddActuator(spec, joint);
    actuator->actdim = 2;
    actuator->plugin.active = 1;
    actuator->plugin.element = instance->element;
    mjs_setString(actuator->plugin.plugin_name, mjs_getString(instance->plugin_name));
    mjs_setString(actuator->plugin.name, "idle");
  }
}

void WithMotors(mjSpec& spec, const std::vector<std::string>& joints) {
  for (const std::string& joint : joints) mjs_setToMotor(AddActuator(spec, joint));
}

Change WithFrictionLoss(double level) {
  return [level](mjSpec& spec, const std::vector<std::string>& joints) {
    for (const std::string& joint : joints) {
      mjs_asJoint(mjs_findElement(&spec, mjOBJ_JOINT, joint.c_str()))->frictionloss = level;
    }
  };
}

Change WithDcMotors(double level) {
  return [level](mjSpec& spec, const std::vector<std::string>& joints) {
    for (const std::string& joint : joints) {
      mjsActuator* motor = AddActuator(spec, joint);
      double constants[2] = {0, 0}, lugre[5] = {1000, 10, level, 1.3 * level, 0.05};
      const std::string refusal = mjs_setToDCMotor(motor, constants, 1, nullptr, nullptr, nullptr,
                                                   nullptr, nullptr, nullptr, lugre, mjINPUT_NONE);
      if (!refusal.empty()) Refuse({"bench"}, "{}", refusal);
    }
  };
}

struct Variant {
  std::string name;
  ModelPtr model;
  DataPtr data;
  bool has_friction;
  std::vector<double> times{};   // s, of each round
  std::vector<double> ratios{};  // of each round, to the variant without friction
};

double ThreadSeconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

const char* Name(Drive drive) {
  constexpr const char* kNames[] = {"sliding", "turning", "mixed", "some held", "held"};
  return kNames[static_cast<int>(drive)];
}

/// Where a round begins, for the regimes that do not go on from one to the next.
void Begin(Variant& variant, const Regime& regime) {
  const mjModel* m = variant.model.get();
  mjData* d = variant.data.get();
  if (regime.drive != Drive::some_held && !(regime.drive == Drive::mixed && d->time == 0)) return;
  mj_resetData(m, d);
  const int held = regime.arm == Arm::humanoid ? 3 : 2;
  for (int i = 0; i < m->njnt; ++i) {
    const bool stays = regime.drive == Drive::some_held && i >= 2 && i < 2 + held;
    if (m->jnt_type[i] == mjJNT_HINGE && !stays) d->qvel[m->jnt_dofadr[i]] = 1;
  }
}

constexpr double kSpeed = 2;       // rad/s, of joints that slide
constexpr double kFirmness = 0.1;  // of drives: share of a lack of speed that one step makes up

/// Torques of the motors, N.m.
void Control(Variant& variant, const Regime& regime) {
  const mjModel* m = variant.model.get();
  mjData* d = variant.data.get();
  const double level = regime.level();
  const Drive drive = regime.drive;
  const int others = regime.arm == Arm::humanoid ? 6 : 0;  // degrees of freedom before the hinges
  for (int j = others; j < m->nv; ++j) {
    const double firm = kFirmness / (m->dof_invweight0[j] * m->opt.timestep);
    const double swing = 6 * level / (1 + 0.3 * j) * std::sin((2 + j) * d->time);
    const double keeps =
        d->qfrc_bias[j] + firm * (kSpeed - d->qvel[j]) + (variant.has_friction ? level : 0);
    d->ctrl[j - others] = drive == Drive::sliding   ? keeps
                          : drive == Drive::turning ? swing
                          : drive == Drive::mixed   ? 8
                                                    : 0;
  }
}

/// One round.
void Run(Variant& variant, const Regime& regime) {
  const mjModel* m = variant.model.get();
  mjData* d = variant.data.get();
  Begin(variant, regime);
  const double begin = ThreadSeconds();
  for (int i = 0; i < kSteps; ++i) {
    Control(variant, regime);
    mj_step(m, d);
  }
  variant.times.push_back(ThreadSeconds() - begin);
}

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// only: part of the names of those that are made beside the arm without friction; empty: all.
std::vector<Variant> MakeVariants(const Regime& regime, int noslip, const std::string& only) {
  std::vector<Variant> variants;
  const auto add = [&](const std::string& name, const Change& change, bool has_friction) {
    if (!variants.empty() && name.find(only) == std::string::npos) return;
    ModelPtr model = MakeArm(regime, noslip, change);
    DataPtr data(mj_makeData(model.get()));
    variants.push_back({name, std::move(model), std::move(data), has_friction});
  };
  const auto nothing = [](mjSpec&, const auto&) {};
  add("no friction", nothing, false);
  add("no friction, again", nothing, false);
  add("as many motors more", WithMotors, false);
  const double level = regime.level();
  add("frictionloss", WithFrictionLoss(level), true);
  add("dcmotor LuGre", WithDcMotors(level), true);
  add("idle plugin, passive", WithIdlePassive, false);
  add("passive, simple", WithFriction(Simple(level), FrictionForm::passive), true);
  add("passive, full", WithFriction(Full(level), FrictionForm::passive), true);
  add("idle plugin, actuators of two states", WithIdleActuators, false);
  add("actuator, simple", WithFriction(Simple(level), FrictionForm::actuator), true);
  add("actuator, full", WithFriction(Full(level), FrictionForm::actuator), true);
  return variants;
}

void Compare(const std::string& title, const Regime& regime, int rounds, const std::string& only) {
  std::vector<std::vector<Variant>> columns;
  for (const int noslip : kNoslip) {
    columns.push_back(MakeVariants(regime, noslip, only));
  }
  for (int round = 0; round < rounds; ++round) {
    for (std::vector<Variant>& variants : columns) {
      for (Variant& variant : variants) {
        Run(variant, regime);
        variant.ratios.push_back(variant.times.back() / variants.front().times.back());
      }
    }
  }
  fmt::print("\n{:<44} {:>8} {:>9} {:>9} {:>12}\n", title, "us/step", "noslip 0", "3",
             "speed rad/s");
  for (size_t i = 0; i < columns.front().size(); ++i) {
    const Variant& variant = columns.front()[i];
    double speed = 0;
    for (int j = 0; j < variant.model->nv; ++j) {
      speed = std::max(speed, std::abs(variant.data->qvel[j]));
    }
    fmt::print("{:<44} {:8.3f}", variant.name, 1e6 * Median(variant.times) / kSteps);
    for (const auto& variants : columns) fmt::print(" {:9.3f}", Median(variants[i].ratios));
    fmt::print(" {:12.3g}\n", speed);
  }
}

}  // namespace
}  // namespace warmjoint

/// Arguments: the number of rounds, 200 where not given, part of the names of the variants to compare, and part of the
/// titles of the tables, to profile one of them.
int main(int argc, char** argv) {
  using namespace warmjoint;
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 200;
  const std::string only = argc > 2 ? argv[2] : "", titles = argc > 3 ? argv[3] : "";
  constexpr const char* kArms[] = {"serial arm", "industrial arm", "humanoid"};
  for (const Arm arm : {Arm::serial, Arm::industrial, Arm::humanoid}) {
    for (const mjtIntegrator integrator : {mjINT_IMPLICITFAST, mjINT_EULER}) {
      for (const Drive drive :
           {Drive::sliding, Drive::turning, Drive::mixed, Drive::some_held, Drive::held}) {
        const std::string title =
            fmt::format("{}, {}, {}", kArms[static_cast<int>(arm)],
                        integrator == mjINT_EULER ? "Euler" : "implicitfast", Name(drive));
        if (title.find(titles) == std::string::npos) continue;
        Compare(title, {arm, integrator, drive}, rounds, only);
      }
    }
  }
  return 0;
}
