// What friction costs in a step of MuJoCo: one 6-axis arm, one thread, ratios of one run.
//
// Ratios are to the arm without actuators, and to that with six motors that do nothing, which is
// what the engine takes for actuators as such. Every arm has the same joint damping and the same
// swinging drive. Rounds of the variants take turns, and the fastest round of each counts, so that
// a busy machine disturbs all of them alike.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <vector>

#include "sim/model/friction_actuator.h"
#include "sim/model/load_model.h"
#include "sim/model/spec_elements.h"
#include "tests/support/folders.h"

namespace warmjoint {
namespace {

constexpr int kRounds = 300;
constexpr int kSteps = 400;        // of a round
constexpr double kDamping = 2;     // N.m.s/rad, of every joint
constexpr double kLevel = 3;       // N.m
constexpr double kStep = 0.001;    // s
constexpr double kAmplitude = 60;  // N.m, of the drive

using Change = std::function<void(mjSpec&, const std::vector<std::string>&)>;

/// The arm without actuators and contacts, changed, compiled.
ModelPtr MakeArm(mjtIntegrator integrator, const Change& change) {
  const auto file = test::SourceFolder() / "models/robots/irb140_like/irb140_like.xml";
  const ParsedModel parsed = ParseModel(file);
  mjSpec& spec = *parsed.spec;
  for (const mjtObj type : {mjOBJ_KEY, mjOBJ_SENSOR, mjOBJ_ACTUATOR}) {
    for (mjsElement* element : SpecElements(spec, type)) mjs_delete(&spec, element);
  }
  for (mjsElement* element : SpecElements(spec, mjOBJ_JOINT)) {
    mjsJoint* joint = mjs_asJoint(element);
    ClearOwnFriction(*joint);
    joint->damping[0] = kDamping;
    joint->limited = mjLIMITED_FALSE;
    joint->actfrclimited = mjLIMITED_FALSE;
  }
  spec.option.timestep = kStep;
  spec.option.integrator = integrator;
  spec.option.disableflags |= mjDSBL_CONTACT;
  change(spec, SpecNames(spec, mjOBJ_JOINT));
  return CompileModel(spec, {file.string()});
}

mjsActuator* AddActuator(mjSpec& spec, const std::string& joint) {
  mjsActuator* actuator = mjs_addActuator(&spec, nullptr);
  mjs_setString(actuator->target, joint.c_str());
  actuator->trntype = mjTRN_JOINT;
  return actuator;
}

FrictionDescription Simple() {
  FrictionDescription friction;
  friction.law = "asymmetric";
  friction.parameters = {
      {"viscous", 0.5}, {"coulomb_positive", kLevel}, {"coulomb_negative", 1.1 * kLevel}};
  friction.thermal = Thermal{-0.05, 300};
  friction.gear = 100;
  return friction;
}

/// The simple one with Stribeck's level and a map of 36 motor angles times 6 speeds.
FrictionDescription Full() {
  FrictionDescription friction = Simple();
  friction.law = "stribeck";
  friction.parameters = {{"viscous", 0.5},
                         {"coulomb", kLevel},
                         {"static", 1.3 * kLevel},
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

Change WithFriction(const FrictionDescription& friction) {
  return [friction](mjSpec& spec, const std::vector<std::string>& joints) {
    std::vector<FrictionForJoint> frictions;
    for (const std::string& joint : joints) frictions.push_back({joint, friction});
    AddFriction(spec, frictions, {"bench"});
  };
}

void WithServos(mjSpec& spec, const std::vector<std::string>& joints) {
  for (const std::string& joint : joints) mjs_setToVelocity(AddActuator(spec, joint), 5);
}

void WithMotors(mjSpec& spec, const std::vector<std::string>& joints) {
  for (const std::string& joint : joints) mjs_setToMotor(AddActuator(spec, joint));
}

void WithFrictionLoss(mjSpec& spec, const std::vector<std::string>&) {
  for (mjsElement* element : SpecElements(spec, mjOBJ_JOINT)) {
    mjs_asJoint(element)->frictionloss = kLevel;
  }
}

void WithDcMotors(mjSpec& spec, const std::vector<std::string>& joints) {
  for (const std::string& joint : joints) {
    mjsActuator* motor = AddActuator(spec, joint);
    double constants[2] = {0, 0}, lugre[5] = {1000, 10, kLevel, 1.3 * kLevel, 0.05};
    const std::string refusal = mjs_setToDCMotor(motor, constants, 1, nullptr, nullptr, nullptr,
                                                 nullptr, nullptr, nullptr, lugre, mjINPUT_NONE);
    if (!refusal.empty()) Refuse({"bench"}, "{}", refusal);
  }
}

struct Variant {
  const char* name;
  ModelPtr model;
  DataPtr data;
  double fastest = 1e9;  // s, of a step
};

/// One round: steps the arm under a swinging drive.
void Run(Variant& variant) {
  const mjModel* m = variant.model.get();
  mjData* d = variant.data.get();
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < m->nv; ++j) {
      d->qfrc_applied[j] = d->qfrc_bias[j] + kAmplitude / (1 + j) * std::sin((2 + j) * d->time);
    }
    mj_step(m, d);
  }
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
  variant.fastest = std::min(variant.fastest, time.count() / kSteps);
}

void Compare(const char* title, mjtIntegrator integrator) {
  std::vector<Variant> variants;
  const auto add = [&](const char* name, const Change& change) {
    ModelPtr model = MakeArm(integrator, change);
    DataPtr data(mj_makeData(model.get()));
    variants.push_back({name, std::move(model), std::move(data)});
  };
  add("no friction", [](mjSpec&, const auto&) {});
  add("six motors alone", WithMotors);
  add("velocity servos", WithServos);
  add("frictionloss", WithFrictionLoss);
  add("dcmotor LuGre", WithDcMotors);
  add("ours, simple", WithFriction(Simple()));
  add("ours, full", WithFriction(Full()));

  for (int round = 0; round < kRounds; ++round) {
    for (Variant& variant : variants) Run(variant);
  }
  fmt::print("{:<18} {:>9} {:>11} {:>10} {:>12}\n", title, "us/step", "to nothing", "to motors",
             "speed rad/s");
  for (const Variant& variant : variants) {
    double speed = 0;
    for (int j = 0; j < variant.model->nv; ++j) {
      speed = std::max(speed, std::abs(variant.data->qvel[j]));
    }
    fmt::print("{:<18} {:9.3f} {:11.3f} {:10.3f} {:12.3f}\n", variant.name, 1e6 * variant.fastest,
               variant.fastest / variants[0].fastest, variant.fastest / variants[1].fastest, speed);
  }
}

}  // namespace
}  // namespace warmjoint

int main() {
  warmjoint::Compare("implicitfast", mjINT_IMPLICITFAST);
  warmjoint::Compare("Euler", mjINT_EULER);
  return 0;
}
