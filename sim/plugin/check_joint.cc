#include "sim/plugin/check_joint.h"

#include <cmath>

#include "models/friction/bristle.h"
#include "sim/plugin/stiff_drives.h"

namespace warmjoint::inline sim {
namespace {

/// How far a bristle may wind up before it slides.
constexpr double kLargestWindUp = 0.05;         // rad
constexpr double kLargestLinearWindUp = 0.005;  // m

/// A little more, so that the three digits of a message are enough.
double RoundUp(double value) { return 1.01 * value; }

/// The first three digits, so that what a message prints is not more. value: positive.
double RoundDown(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 2);
  // a number of three digits may lie a rounding error below itself
  return std::floor(value / unit * (1 + 1e-12)) * unit;
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
         slope, inertia, h, RoundUp(needed - inertia), RoundDown(inertia / (2 * slope)));
}

/// How far the bristle winds up before it slides: level h^2 / (A M).
void CheckWindUp(const JointFriction& friction, const BristleShape& bristles, double inertia,
                 double h, JointKind kind, const Place& place) {
  const double level = friction.HoldingLevel();
  const double allowed = kind == JointKind::rotary ? kLargestWindUp : kLargestLinearWindUp;
  const double needed = level * h * h / (bristles.stiffness * allowed);
  if (needed <= inertia) return;
  Refuse(place,
         "friction holds up to {:.3g} on an effective inertia of {:.3g} at timestep {}; it would "
         "give way by {:.3g} {} before it slides, at most {} are allowed: add an armature of "
         "{:.3g} or take a timestep of at most {:.3g} s",
         level, inertia, h, level * h * h / (bristles.stiffness * inertia), kPositionUnit.For(kind),
         allowed, RoundUp(needed - inertia), RoundDown(h * std::sqrt(inertia / needed)));
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
         bristle.stiffness, b, inertia, h, RoundUp(needed - inertia), RoundDown(longest));
}

}  // namespace

std::string JointName(const mjModel* m, int joint) {
  const char* name = mj_id2name(m, mjOBJ_JOINT, joint);
  if (name && name[0]) return fmt::format("joint '{}'", name);
  return fmt::format("joint {}", joint);
}

void CheckJoint(const mjModel* m, int joint, const JointFriction& friction,
                const BristleShape& bristles, const Place& place) {
  const int type = m->jnt_type[joint];
  if (type != mjJNT_HINGE && type != mjJNT_SLIDE) {
    Refuse(place, "{} is neither hinge nor slide; friction acts on these alone",
           JointName(m, joint));
  }

  // the compiler asks once before it knows the inertia, and again after
  const double inertia = EffectiveInertia(m, m->jnt_dofadr[joint]);
  if (inertia == 0) return;
  const JointKind kind = type == mjJNT_SLIDE ? JointKind::linear : JointKind::rotary;
  CheckSlope(friction, inertia, m->opt.timestep, place);
  if (friction.own_bristle()) {
    CheckBristle(*friction.own_bristle(), inertia, m->opt.timestep, place);
  } else {
    CheckWindUp(friction, bristles, inertia, m->opt.timestep, kind, place);
  }
}

void CheckDrive(const mjModel* m, int joint, const JointFriction& friction, int instances,
                double drive, const Place& place) {
  if (drive == 0) return;
  // the friction's own slope over speed is explicit, too
  const int dof = m->jnt_dofadr[joint];
  const double h = m->opt.timestep;
  const double slope = friction.SteepestSlope() * h / EffectiveInertia(m, dof);
  const auto [stiffness, damping] = BristlesOf(instances, drive);
  const double bristles = stiffness * (1 - slope) + 2 * std::max(0.0, damping - slope);
  const double added = drive + 2 * slope;
  if (added + std::min<double>(instances, kLargestCoupling) * bristles < 4) return;

  const bool implicit_helps =
      StiffestDrives(m, mjINT_IMPLICITFAST)[m->dof_treeid[dof]] <= kStiffestDrive;
  Refuse(place,
         "servos and springs are too stiff for timestep {}: with their h^2 stiffness + 2 h damping "
         "over the inertia at {:.3g}, above {}, the joint may shake instead of resting; take {}a "
         "timestep of at most {:.3g} s (attach --timestep) or more armature (--armature)",
         h, added, kStiffestDrive,
         implicit_helps ? "the integrator implicitfast (attach --integrator implicitfast), " : "",
         RoundDown(h * kStiffestDrive / added));
}

double WindUp(const mjModel* m, int joint, const JointFriction& friction,
              const BristleShape& bristles) {
  const double inertia = EffectiveInertia(m, m->jnt_dofadr[joint]), h = m->opt.timestep;
  if (friction.own_bristle() || inertia == 0) return 0;
  return friction.HoldingLevel() * h * h / (bristles.stiffness * inertia);
}

}  // namespace warmjoint::inline sim
