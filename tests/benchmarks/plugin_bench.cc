// What friction costs in a step of MuJoCo: two 6-axis arms with six motors, one thread, ratios of one
// run to the arm without friction.
//
//   serial arm: six hinges in a row, damping 2 N.m.s/rad, steps of 2 ms
//   industrial arm: models/robots/irb140_like, the same damping, steps of 1 ms
//
// "sliding" is under drives that keep the speed of all joints, "turning" under torques that swing so widely that now the
// one, now the other joint comes to a stop, "held" at rest under gravity.
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
constexpr int kNoslip[] = {0, 3, 20};

using Change = std::function<void(mjSpec&, const std::vector<std::string>&)>;

enum class Arm { serial, industrial };

/// Friction's level on every joint, N.m: what holds the arm at rest under gravity.
double LevelOf(Arm arm) { return arm == Arm::serial ? 30 : 80; }

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

/// The arm with six motors and no contacts, changed, compiled.
ModelPtr MakeArm(Arm arm, mjtIntegrator integrator, int noslip, const Change& change) {
  const SpecPtr spec = arm == Arm::serial ? SerialArm() : IndustrialArm();
  for (mjsElement* element : SpecElements(*spec, mjOBJ_JOINT)) {
    mjsJoint* joint = mjs_asJoint(element);
    ClearOwnFriction(*joint);
    joint->damping[0] = kDamping;
    joint->limited = mjLIMITED_FALSE;
    joint->actfrclimited = mjLIMITED_FALSE;
  }
  spec->option.integrator = integrator;
  spec->option.noslip_iterations = noslip;
  spec->option.disableflags |= mjDSBL_CONTACT;
  const auto joints = SpecNames(*spec, mjOBJ_JOINT);
  for (const std::string& joint : joints) mjs_setToMotor(AddActuator(*spec, joint));
  change(*spec, joints);
  return CompileModel(*spec, {"bench"});
}

FrictionDescription Simple(Arm arm) {
  FrictionDescription friction;
  friction.law = "asymmetric";
  friction.parameters = {{"viscous", 0.5},
                         {"coulomb_positive", LevelOf(arm)},
                         {"coulomb_negative", 1.1 * LevelOf(arm)}};
  friction.thermal = Thermal{-0.001, 300};
  friction.gear = 100;
  return friction;
}

/// The simple one with Stribeck's level and a map of 36 motor angles times 6 speeds.
FrictionDescription Full(Arm arm) {
  FrictionDescription friction = Simple(arm);
  friction.law = "stribeck";
  friction.parameters = {{"viscous", 0.5},
                         {"coulomb", LevelOf(arm)},
                         {"static", 1.3 * LevelOf(arm)},
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

Change WithFriction(const FrictionDescription& friction, FrictionForm form) {
  return [friction, form](mjSpec& spec, const std::vector<std::string>& joints) {
    std::vector<FrictionForJoint> frictions;
    for (const std::string& joint : joints) frictions.push_back({joint, friction});
    AddFriction(spec, frictions, {"bench"}, form);
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
  return [level](mjSpec& spec, const std::vector<std::string>&) {
    for (mjsElement* element : SpecElements(spec, mjOBJ_JOINT)) {
      mjs_asJoint(element)->frictionloss = level;
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

enum class Drive { sliding, turning, held };

const char* Name(Drive drive) {
  constexpr const char* kNames[] = {"sliding", "turning", "held"};
  return kNames[static_cast<int>(drive)];
}

constexpr double kSpeed = 2;       // rad/s, of joints that slide
constexpr double kFirmness = 0.1;  // of drives: share of a lack of speed that one step makes up

/// Torques of the motors, N.m. level: of friction, where there is one, N.m
void Control(Variant& variant, Drive drive, double level) {
  const mjModel* m = variant.model.get();
  mjData* d = variant.data.get();
  for (int j = 0; j < m->nv; ++j) {
    const double firm = kFirmness / (m->dof_invweight0[j] * m->opt.timestep);
    const double swing = 6 * level / (1 + 0.3 * j) * std::sin((2 + j) * d->time);
    const double keeps =
        d->qfrc_bias[j] + firm * (kSpeed - d->qvel[j]) + (variant.has_friction ? level : 0);
    d->ctrl[j] = drive == Drive::sliding ? keeps : drive == Drive::turning ? swing : 0;
  }
}

/// One round.
void Run(Variant& variant, Drive drive, double level) {
  const mjModel* m = variant.model.get();
  mjData* d = variant.data.get();
  const double begin = ThreadSeconds();
  for (int i = 0; i < kSteps; ++i) {
    Control(variant, drive, level);
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
std::vector<Variant> MakeVariants(Arm arm, mjtIntegrator integrator, int noslip,
                                  const std::string& only) {
  std::vector<Variant> variants;
  const auto add = [&](const std::string& name, const Change& change, bool has_friction) {
    if (!variants.empty() && name.find(only) == std::string::npos) return;
    ModelPtr model = MakeArm(arm, integrator, noslip, change);
    DataPtr data(mj_makeData(model.get()));
    variants.push_back({name, std::move(model), std::move(data), has_friction});
  };
  const auto nothing = [](mjSpec&, const auto&) {};
  add("no friction", nothing, false);
  add("no friction, again", nothing, false);
  add("six more motors", WithMotors, false);
  add("frictionloss", WithFrictionLoss(LevelOf(arm)), true);
  add("dcmotor LuGre", WithDcMotors(LevelOf(arm)), true);
  add("idle plugin, passive", WithIdlePassive, false);
  add("passive, simple", WithFriction(Simple(arm), FrictionForm::passive), true);
  add("passive, full", WithFriction(Full(arm), FrictionForm::passive), true);
  add("idle plugin, six actuators of two states", WithIdleActuators, false);
  add("actuator, simple", WithFriction(Simple(arm), FrictionForm::actuator), true);
  add("actuator, full", WithFriction(Full(arm), FrictionForm::actuator), true);
  return variants;
}

void Compare(const std::string& title, Arm arm, mjtIntegrator integrator, Drive drive, int rounds,
             const std::string& only) {
  std::vector<std::vector<Variant>> columns;
  for (const int noslip : kNoslip) {
    columns.push_back(MakeVariants(arm, integrator, noslip, only));
  }
  for (int round = 0; round < rounds; ++round) {
    for (std::vector<Variant>& variants : columns) {
      for (Variant& variant : variants) {
        Run(variant, drive, LevelOf(arm));
        variant.ratios.push_back(variant.times.back() / variants.front().times.back());
      }
    }
  }
  fmt::print("\n{:<44} {:>8} {:>9} {:>9} {:>9} {:>12}\n", title, "us/step", "noslip 0", "3", "20",
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
  for (const Arm arm : {Arm::serial, Arm::industrial}) {
    for (const mjtIntegrator integrator : {mjINT_IMPLICITFAST, mjINT_EULER}) {
      const std::string name =
          fmt::format("{} arm, {}", arm == Arm::serial ? "serial" : "industrial",
                      integrator == mjINT_EULER ? "Euler" : "implicitfast");
      for (const Drive drive : {Drive::sliding, Drive::turning, Drive::held}) {
        const std::string title = fmt::format("{}, {}", name, Name(drive));
        if (title.find(titles) == std::string::npos) continue;
        Compare(title, arm, integrator, drive, rounds, only);
      }
    }
  }
  return 0;
}
