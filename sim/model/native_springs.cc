#include "sim/model/native_springs.h"

#include <fmt/ranges.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

#include "models/foundation/excerpt.h"
#include "models/friction/joint_friction.h"
#include "models/friction/joint_spring.h"
#include "sim/model/friction_actuator.h"
#include "sim/model/spec_elements.h"
#include "sim/plugin/plugin_instances.h"
#include "sim/plugin/stability.h"

namespace warmjoint {
namespace {

/// A spring with a yield of 0 does not yield.
constexpr double kSmallestYield = 1e-12;

constexpr char kNative[] = "native";

double ParameterOr(const Friction& friction, const char* name, double otherwise) {
  const auto found = friction.parameters.find(name);
  return found == friction.parameters.end() ? otherwise : found->second;
}

/// A law without sides, without a level of its own at rest and without a bristle; what that is off by.
Friction Plain(const Friction& given, const JointUnit& level, JointKind kind,
               std::vector<std::string>& lost) {
  Friction plain = given;
  std::map<std::string, double>& of = plain.parameters;
  const std::string_view unit = level.For(kind);
  // levels by sides
  if (of.contains("coulomb_positive")) {
    const double up = of["coulomb_positive"], down = of["coulomb_negative"];
    of["coulomb"] = (up + down) / 2;
    if (up != down) {
      lost.push_back(fmt::format("asymmetry ({} and {} become {:.4g} {}, off by {:.3g})", up, down,
                                 of["coulomb"], unit, std::abs(up - down) / 2));
    }
    if (of.contains("static_rise")) of["static"] = of["coulomb"] + of["static_rise"];
  }
  if (given.law == "stiction") {
    lost.push_back(fmt::format("stiction (a joint at rest holds {} {}, not {})", of["coulomb"],
                               unit, of["static"]));
  }
  const bool bristle = of.contains("bristle_stiffness");
  if (bristle) {
    lost.push_back(fmt::format("the bristle's shape (stiffness {} {})", of["bristle_stiffness"],
                               kStiffnessUnit.For(kind)));
  }
  // what is left of the law
  const bool falls = of.contains("stribeck_velocity");
  if (falls && bristle) of.try_emplace("stribeck_exponent", 2.0);
  plain.law = falls ? "stribeck" : of.contains("viscous") ? "viscous_coulomb" : "coulomb";
  std::map<std::string, double> kept;
  for (const ParameterInfo& info : FindLaw(plain.law)->parameters) {
    kept[std::string(info.name)] = ParameterOr(plain, info.name.data(), info.default_value);
  }
  plain.parameters = kept;
  return plain;
}

/// Throws BadInput where the model's step does not carry springs.
void CheckStep(const mjModel* m, const Place& place) {
  if (m->opt.disableflags & (mjDSBL_SPRING | mjDSBL_DAMPER)) {
    Refuse(place, "the model's flag spring or damper is disabled, and with it friction; enable it");
  }
  const bool discrete = m->opt.integrator != mjINT_EULER && m->opt.integrator != mjINT_RK4 &&
                        m->opt.integrator != mjINT_IMPLICIT &&
                        m->opt.integrator != mjINT_IMPLICITFAST;
  if (!discrete && DampsImplicitly(m, m->opt.integrator)) return;
  Refuse(place, "the model's integrator {}; take --integrator implicitfast",
         discrete
             ? "discrete takes springs implicitly, which then drag a joint that slides by h k v"
             : "takes damping explicitly, so that a spring of a joint at rest rings");
}

/// A joint with its spring.
struct Sprung {
  int joint = 0;  // in the model
  JointKind kind = JointKind::rotary;
  double level = 0;  // at rest, cold, N.m or N
  double start = 0;  // with the heat at the start
};

Sprung SprungOf(const mjModel* m, const FrictionForJoint& friction) {
  Sprung sprung;
  sprung.joint = mj_name2id(m, mjOBJ_JOINT, friction.joint.c_str());
  const bool slides = m->jnt_type[sprung.joint] == mjJNT_SLIDE;
  sprung.kind = slides ? JointKind::linear : JointKind::rotary;
  sprung.level = JointFriction(friction.friction).OwnLevelAtRest(1);
  sprung.start = sprung.level;
  for (const double energy : friction.initial_energy) sprung.start += energy;
  return sprung;
}

/// A number of two digits on the side of `round`.
double TwoDigits(double value, double (*round)(double)) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
  return round(value / unit) * unit;
}

double Up(double x) { return std::ceil(x); }
double Down(double x) { return std::floor(x); }

/// Raises the viscous of a friction that has too little of it, or refuses it.
void TakeViscous(SpringFriction& of, const Sprung& sprung) {
  const double viscous = JointFriction(of.friction.friction).viscous();
  const double least = LeastViscous(sprung.level, sprung.kind);
  if (viscous >= least) return;
  of.lost.push_back(
      fmt::format("a viscous of {} {} (at least {:.4g}, so that a held spring comes "
                  "to rest beside a level of {:.4g})",
                  viscous, kViscousUnit.For(sprung.kind), TwoDigits(least, Up), sprung.level));
  if (of.friction.friction.law == "coulomb") of.friction.friction.law = "viscous_coulomb";
  of.friction.friction.parameters["viscous"] = TwoDigits(least, Up);
}

/// Throws BadInput where the joint would give way too far.
void CheckGive(const mjModel* m, const Sprung& sprung, double stiffness, const Place& place) {
  const double give = sprung.level / stiffness;
  const double most = LargestGive(sprung.kind);
  if (give <= most) return;
  // the give grows with h^2 and falls with the inertia
  const double h = m->opt.timestep * std::sqrt(most / give);
  const int dof = m->jnt_dofadr[sprung.joint];
  const double armature = m->dof_armature[dof] + (give / most - 1) * EffectiveInertia(m, dof);
  Refuse(place,
         "the step of {} s is too long: the spring would give way by {:.3g} {} before it slides, "
         "at most {} are allowed; take --timestep {:.2g}, or --armature {}={:.2g}",
         m->opt.timestep, give, kPositionUnit.For(sprung.kind), most, TwoDigits(h, Down),
         Excerpt(NameIn(m, mjOBJ_JOINT, sprung.joint)), TwoDigits(armature, Up));
}

/// A joint's friction as its spring holds it. Throws BadInput where it cannot; notices: what is left out or replaced.
FrictionForJoint HeldBySpring(const mjModel* m, int joint, const FrictionForJoint& given,
                              const AttachOptions& options, std::vector<std::string>& notices) {
  const Place place{JointName(m, joint)};
  const bool slides = m->jnt_type[joint] == mjJNT_SLIDE;
  SpringFriction of = InSpring(given, slides ? JointKind::linear : JointKind::rotary);
  TakeViscous(of, SprungOf(m, of.friction));
  if (!of.lost.empty() && !options.approximate) {
    Refuse(place,
           "a spring with a yield does not hold {}; take --as passive, or --approximate, "
           "which replaces that and prints what it is off by",
           fmt::join(of.lost, ", "));
  }
  if (!of.lost.empty()) {
    notices.push_back(fmt::format("{}: its spring leaves out or replaces {}", given.joint,
                                  fmt::join(of.lost, ", ")));
  }
  if (m->jnt_stiffness[joint] != 0) {
    Refuse(place, "has a spring of its own, and MuJoCo gives a joint one; take --as passive");
  }
  return of.friction;
}

/// The yield in radians; FinishSprings sees to other units.
void SetSpring(mjsJoint& joint, const NativeSpring& spring) {
  joint.stiffness[0] = spring.stiffness;
#if mjVERSION_HEADER >= 4000000
  joint.springyield = spring.yield;
#endif
  joint.springref = joint.ref;
  joint.damping[0] = JointFriction(spring.friction.friction).viscous();
}

/// The joints in the order of the arrays.
void AddTuple(mjSpec& spec, const std::vector<FrictionForJoint>& frictions) {
  mjsTuple* tuple = mjs_addTuple(&spec);
  mjs_setName(tuple->element, kNative);
  const std::vector<double> none(frictions.size(), 0);
  std::vector<int> types(frictions.size(), mjOBJ_JOINT);
  mjs_setInt(tuple->objtype, types.data(), static_cast<int>(types.size()));
  mjs_setDouble(tuple->objprm, none.data(), static_cast<int>(none.size()));
  for (const FrictionForJoint& one : frictions) {
    mjs_appendString(tuple->objname, one.joint.c_str());
  }
}

}  // namespace

SpringFriction InSpring(const FrictionForJoint& given, JointKind kind) {
  SpringFriction found{given, {}};
  Friction& of = found.friction.friction;
  of = Plain(of, kTorqueUnit, kind, found.lost);
  if (!of.maps.empty()) {
    const double most = JointFriction(given.friction).HoldingLevel() -
                        std::max(JointFriction(given.friction).OwnLevelAtRest(1),
                                 JointFriction(given.friction).OwnLevelAtRest(-1));
    found.lost.push_back(fmt::format("{} map{} (up to {:.3g} {})", of.maps.size(),
                                     of.maps.size() == 1 ? "" : "s", most, kTorqueUnit.For(kind)));
    of.maps.clear();
  }
  // what changes the level or the slope besides heat
  const std::pair<double Friction::*, const char*> rest[] = {
      {&Friction::load_gain, "load_gain ({:.3g} of the load)"},
      {&Friction::viscous_per_energy, "viscous_per_energy ({:.3g} of the heat)"},
      {&Friction::level_per_temperature, "level_per_temperature ({:.3g} for each K)"}};
  for (const auto& [member, words] : rest) {
    if (of.*member == 0) continue;
    found.lost.push_back(fmt::format(fmt::runtime(words), of.*member));
    of.*member = 0;
  }
  return found;
}

std::vector<double> SpringStiffnesses(const mjModel* m, const std::vector<char>& takes) {
  // the least inertia of each joint with all the others free to move, over poses
  std::vector<Eigen::VectorXd> least(static_cast<size_t>(m->ntree));
  const auto block = [&](int tree, const Eigen::MatrixXd& inertia) {
    const int first = m->tree_dofadr[tree], size = m->tree_dofnum[tree];
    return Eigen::MatrixXd(inertia.block(first, first, size, size));
  };
  OverPoses(m, [&](const Eigen::MatrixXd& inertia) {
    for (int tree = 0; tree < m->ntree; ++tree) {
      const Eigen::VectorXd free = block(tree, inertia).inverse().diagonal().cwiseInverse();
      Eigen::VectorXd& of = least[static_cast<size_t>(tree)];
      of = of.size() == 0 ? free : Eigen::VectorXd(of.cwiseMin(free));
      for (int i = 0; i < of.size(); ++i) {
        if (!takes[static_cast<size_t>(m->tree_dofadr[tree] + i)]) of[i] = 0;
      }
    }
  });
  // springs in proportion to it, as stiff as the stiffest mode allows
  std::vector<double> mode(static_cast<size_t>(m->ntree), 0);
  OverPoses(m, [&](const Eigen::MatrixXd& inertia) {
    for (int tree = 0; tree < m->ntree; ++tree) {
      double& of = mode[static_cast<size_t>(tree)];
      of = std::max(of, StiffestMode(least[static_cast<size_t>(tree)], block(tree, inertia)));
    }
  });
  std::vector<double> stiffness(static_cast<size_t>(m->nv), 0);
  const double h = m->opt.timestep;
  for (int dof = 0; dof < m->nv; ++dof) {
    const int tree = m->dof_treeid[dof];
    const double inertia = least[static_cast<size_t>(tree)][dof - m->tree_dofadr[tree]];
    if (inertia == 0) continue;
    // six digits are written by every version
    const double k = SpringStiffness(inertia, mode[static_cast<size_t>(tree)], h);
    stiffness[static_cast<size_t>(dof)] = TwoDigits(k, Down);
  }
  return stiffness;
}

std::vector<NativeSpring> AddSprings(mjSpec& spec, const mjModel* m,
                                     const std::vector<FrictionForJoint>& frictions,
                                     const AttachOptions& options, const Place& place,
                                     std::vector<std::string>& notices) {
  if (mjVERSION_HEADER < 4000000) {
    Refuse(place,
           "joint springs with a yield came with MuJoCo 4.0, and this is {}; take --as passive",
           mj_versionString());
  }
  if (frictions.empty()) return {};
  CheckStep(m, place);
  if (mjs_findElement(&spec, mjOBJ_TUPLE, kNative)) {
    Refuse(place, "has springs with friction already; attach the friction of all joints at once");
  }
  std::vector<FrictionForJoint> held;
  std::vector<char> takes(static_cast<size_t>(m->nv), 0);
  for (const FrictionForJoint& given : frictions) {
    const int joint = mj_name2id(m, mjOBJ_JOINT, given.joint.c_str());
    held.push_back(HeldBySpring(m, joint, given, options, notices));
    takes[static_cast<size_t>(m->jnt_dofadr[joint])] = 1;
  }

  // springs that the step carries in every pose
  const std::vector<double> stiffness = SpringStiffnesses(m, takes);
  std::vector<NativeSpring> springs;
  for (const FrictionForJoint& friction : held) {
    const Sprung sprung = SprungOf(m, friction);
    const double k = stiffness[static_cast<size_t>(m->jnt_dofadr[sprung.joint])];
    CheckGive(m, sprung, k, {JointName(m, sprung.joint)});
    springs.push_back({friction, k, std::max(kSmallestYield, sprung.start / k)});
    SetSpring(*FindJoint(spec, friction.joint, place), springs.back());
  }
  AddNumbers(spec, held, kNative, Viscous::by_damping);
  AddTuple(spec, held);
  return springs;
}

void FinishSprings([[maybe_unused]] mjSpec& spec, [[maybe_unused]] const mjModel* m,
                   [[maybe_unused]] const std::vector<NativeSpring>& springs) {
#if mjVERSION_HEADER >= 4000000
  std::vector<std::pair<int, int>> places;  // in the plastic states and in qpos
  for (const NativeSpring& spring : springs) {
    const int joint = mj_name2id(m, mjOBJ_JOINT, spring.friction.joint.c_str());
    // hinges have the yield in the unit of their own file's angles, which may be degrees
    if (m->jnt_springyield[joint] > 0) {
      FindJoint(spec, spring.friction.joint, {})->springyield *=
          spring.yield / m->jnt_springyield[joint];
    }
    places.emplace_back(m->jnt_plasticadr[joint], m->jnt_qposadr[joint]);
  }
  // a keyframe begins with relaxed springs
  const std::vector<mjsElement*> keys = SpecElements(spec, mjOBJ_KEY);
  for (size_t i = 0; i < keys.size() && i < static_cast<size_t>(m->nkey); ++i) {
    std::vector<double> plastic(m->key_plastic + i * m->nplastic,
                                m->key_plastic + (i + 1) * m->nplastic);
    for (const auto& [state, position] : places) {
      if (state >= 0) plastic[static_cast<size_t>(state)] = m->key_qpos[i * m->nq + position];
    }
    mjs_setDouble(mjs_asKey(keys[i])->plastic, plastic.data(), static_cast<int>(plastic.size()));
  }
#endif
}

}  // namespace warmjoint
