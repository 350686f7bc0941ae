#include <fmt/ranges.h>

#include <cmath>

#include "models/foundation/parse_number.h"
#include "models/friction/joint_friction.h"
#include "sim/model/friction_actuator.h"
#include "sim/plugin/plugin_instances.h"
#include "sim/plugin/stability.h"

namespace warmjoint {
namespace {

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

int JointOf(const mjModel* m, const FrictionForJoint& friction) {
  return mj_name2id(m, mjOBJ_JOINT, friction.joint.c_str());
}

}  // namespace

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
    for (const Asked& asked : AskedOf(m, joint, JointFriction(friction.friction), kLoneBristles)) {
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
                                          const std::vector<FrictionForJoint>& frictions) {
  const std::vector<double> drives = StiffestDrives(m, m->opt.integrator);
  std::vector<std::string> notices, armatures;
  std::string shaking;
  double most = 0;
  for (const FrictionForJoint& friction : frictions) {
    const int joint = JointOf(m, friction);
    const double drive = drives[m->dof_treeid[m->jnt_dofadr[joint]]];
    try {
      CheckDrive(m, joint, drive, {JointName(m, joint)});
    } catch (const BadInput& refused) {
      if (shaking.empty()) shaking = refused.what();
    }
    // the give of the step's own bristle, as a share of the largest
    const JointFriction of(friction.friction);
    if (of.own_bristle()) continue;
    const double asked = AskedOf(m, joint, of, BristlesOf(1, drive))[1].inertia;
    const double share = asked / EffectiveInertia(m, m->jnt_dofadr[joint]);
    const bool slides = m->jnt_type[joint] == mjJNT_SLIDE;
    if (share > most) {
      notices = {
          fmt::format("joints give way elastically before they slide, most of all '{}' by "
                      "{:.2g} {}",
                      friction.joint, share * (slides ? 5 : 50), slides ? "mm" : "mrad")};
    }
    most = std::max(most, share);
    if (share > kSmallGive) armatures.push_back(ArmatureFor(m, joint, asked / kSmallGive));
  }
  if (!armatures.empty()) {
    notices[0] += fmt::format("; for at most 5 mrad (0.5 mm) give {}", fmt::join(armatures, " "));
  }
  if (!shaking.empty()) notices.push_back(shaking);
  return notices;
}

}  // namespace warmjoint
