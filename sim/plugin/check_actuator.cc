#include "sim/plugin/check_actuator.h"

#include <cmath>

#include "models/foundation/bad_input.h"
#include "models/friction/bristle.h"
#include "sim/plugin/friction_instance.h"

namespace warmjoint::inline sim {
namespace {

/// How far a bristle may wind up before it slides.
constexpr double kLargestWindUp = 0.05;         // rad
constexpr double kLargestLinearWindUp = 0.005;  // m

/// A little more, so that the three digits of a message are enough.
double RoundUp(double value) { return 1.01 * value; }

std::string NameOf(const mjModel* m, mjtObj type, const char* what, int id) {
  const char* name = mj_id2name(m, type, id);
  if (name && name[0]) return fmt::format("{} '{}'", what, name);
  return fmt::format("{} {}", what, id);
}

void CheckTransmission(const mjModel* m, int i, const Place& place) {
  if (m->actuator_trntype[i] != mjTRN_JOINT) {
    Refuse(place, "drives no joint; friction needs the attribute joint");
  }
  const int joint = m->actuator_trnid[2 * i];
  const std::string name = NameOf(m, mjOBJ_JOINT, "joint", joint);
  if (m->jnt_type[joint] != mjJNT_HINGE && m->jnt_type[joint] != mjJNT_SLIDE) {
    Refuse(place, "{} is neither hinge nor slide; friction acts on these alone", name);
  }
  if (m->actuator_gear[6 * m->actuator_outadr[i]] != 1) {
    Refuse(place, "gear is {}; the transmission's gear must be 1 (the motor's is a config key)",
           m->actuator_gear[6 * m->actuator_outadr[i]]);
  }
  if (m->jnt_actfrclimited[joint]) {
    Refuse(place,
           "{} has actuatorfrcrange, which would clip friction too; limit the motor's "
           "forcerange instead",
           name);
  }
}

void CheckElement(const mjModel* m, int i, const JointFriction& friction, const Place& place) {
  const auto states = static_cast<size_t>(m->actuator_actadr[i] < 0 ? 0 : m->actuator_actnum[i]);
  if (m->actuator_dyntype[i] != mjDYN_NONE) Refuse(place, "dyntype must be none");
  if (states != friction.state().size()) {
    std::string names;
    for (const StateMember& member : friction.state()) {
      names += fmt::format("{}{}", names.empty() ? "" : ", ", member.name);
    }
    Refuse(place, "actdim is {}; it must be {} ({})", states, friction.state().size(), names);
  }
  if (m->actuator_actlimited[i]) {
    Refuse(place, "has an actrange, which would clip the states; leave it out");
  }
  if (m->actuator_forcelimited[i]) {
    Refuse(place, "has a forcerange, which would clip friction; leave it out");
  }
}

void CheckIntegrator(const mjModel* m, const Place& place) {
  if (m->opt.integrator != mjINT_RK4) return;
  Refuse(place,
         "integrator is RK4, whose inner steps would move the bristle four times; use Euler, "
         "implicit, implicitfast or discrete");
}

/// An explicit slope of force over speed c is well damped up to c h = M / 2, also where coupled
/// joints feel lighter than M, and diverges above 2 M.
void CheckSlope(const JointFriction& friction, double inertia, double h, const Place& place) {
  const double slope = friction.SteepestSlope();
  const double needed = 2 * slope * h;
  if (needed <= inertia) return;
  Refuse(place,
         "friction rises by up to {:.4g} over speed on an effective inertia of {:.3g} at timestep "
         "{}; the step would be "
         "unstable: add an armature of {:.3g} or take a timestep of at most {:.3g} s",
         slope, inertia, h, RoundUp(needed - inertia), inertia / (2 * slope));
}

/// How far the bristle winds up before it slides: level h^2 / (0.1 M).
void CheckWindUp(const JointFriction& friction, double inertia, double h, JointKind kind,
                 const Place& place) {
  const double level = friction.HoldingLevel();
  const double allowed = kind == JointKind::rotary ? kLargestWindUp : kLargestLinearWindUp;
  const double needed = level * h * h / (kBristleStiffness * allowed);
  if (needed <= inertia) return;
  Refuse(place,
         "friction holds up to {:.3g} on an effective inertia of {:.3g} at timestep {}; it would "
         "give way by {:.3g} {} before it slides, at most {} are allowed: add an armature of "
         "{:.3g} or take a timestep of at most {:.3g} s",
         level, inertia, h, level / MakeBristle(inertia, h).stiffness, kPositionUnit.For(kind),
         allowed, RoundUp(needed - inertia), h * std::sqrt(inertia / needed));
}

/// An explicit step carries a law's own bristle while (stiffness + 2 damping) in units of M/h^2 and
/// M/h is at most that of MakeBristle.
void CheckBristle(const Bristle& bristle, double inertia, double h, const Place& place) {
  constexpr double carried = kBristleStiffness + 2 * kBristleDamping;
  const double needed = h * (bristle.stiffness * h + 2 * bristle.damping) / carried;
  if (needed <= inertia) return;
  // largest step: stiffness h^2 + 2 damping h = carried M
  const double b = bristle.damping;
  const double longest =
      carried * inertia / (b + std::sqrt(b * b + carried * inertia * bristle.stiffness));
  Refuse(place,
         "bristle_stiffness is {} and bristle_damping {} on an effective inertia of {:.3g} at "
         "timestep {}; the step would be unstable: add an armature of {:.3g}, take a timestep of "
         "at most {:.3g} s, or soften the bristle",
         bristle.stiffness, b, inertia, h, RoundUp(needed - inertia), longest);
}

}  // namespace

std::string ActuatorName(const mjModel* m, int actuator) {
  return NameOf(m, mjOBJ_ACTUATOR, "actuator", actuator);
}

std::string InstanceName(const mjModel* m, int instance) {
  for (int i = 0; i < m->nactuator; ++i) {
    if (m->actuator_plugin[i] == instance) return ActuatorName(m, i);
  }
  return NameOf(m, mjOBJ_PLUGIN, "plugin instance", instance);
}

void CheckActuator(const mjModel* m, int actuator, const JointFriction& friction) {
  const Place place{ActuatorName(m, actuator)};
  CheckTransmission(m, actuator, place);
  CheckElement(m, actuator, friction, place);
  CheckIntegrator(m, place);

  // the compiler asks once before it knows the inertia, and again after
  const int joint = m->actuator_trnid[2 * actuator];
  const double inertia = EffectiveInertia(m, m->jnt_dofadr[joint]);
  if (inertia == 0) return;
  const JointKind kind = m->jnt_type[joint] == mjJNT_SLIDE ? JointKind::linear : JointKind::rotary;
  CheckSlope(friction, inertia, m->opt.timestep, place);
  if (friction.own_bristle()) {
    CheckBristle(*friction.own_bristle(), inertia, m->opt.timestep, place);
  } else {
    CheckWindUp(friction, inertia, m->opt.timestep, kind, place);
  }
}

}  // namespace warmjoint::inline sim
