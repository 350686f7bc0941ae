#include "sim/plugin/stability.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "models/friction/bristle.h"
#include "sim/plugin/plugin_instances.h"

namespace warmjoint {
namespace {

/// Earlier engines have no such integrator.
bool IsDiscrete([[maybe_unused]] int integrator) {
#if mjVERSION_HEADER >= 3017000
  return integrator == mjINT_DISCRETE;
#else
  return false;
#endif
}

/// Eigenvalues up to this change no BristlesOf. Why: 3.6 of instances that share a tree + 0.3 = kCarried.
constexpr double kMinor = 0.3;

/// Poses of OverPoses.
constexpr int kPoses = 32;

/// The diagonal of h^2 K + 2 h C, kg.m^2 or kg.
Eigen::VectorXd Added(const mjModel* m, int integrator, const std::vector<double>& slopes) {
  const double h = m->opt.timestep, per_damping = integrator == mjINT_EULER ? 2 * h : -2 * h;
  const double per_joint_damping = DampsImplicitly(m, integrator) ? -2 * h : 2 * h;
  Eigen::VectorXd added = 2 * h * Eigen::VectorXd::Map(slopes.data(), m->nv);
  // the joints' own springs and dampers
  const bool springs = !(m->opt.disableflags & mjDSBL_SPRING);
  const bool dampers = !(m->opt.disableflags & mjDSBL_DAMPER);
  for (int dof = 0; dof < m->nv; ++dof) {
    if (springs) added[dof] += h * h * m->jnt_stiffness[m->dof_jntid[dof]];
    if (dampers) added[dof] += per_joint_damping * m->dof_damping[dof];
  }
  for (int i = 0; i < m->nactuator; ++i) {
    if (m->actuator_trntype[i] != mjTRN_JOINT) continue;
    const int dof = m->jnt_dofadr[m->actuator_trnid[2 * i]];
    const double gear = m->actuator_gear[6 * m->actuator_outadr[i]];
    if (dampers) added[dof] += gear * gear * per_joint_damping * m->actuator_damping[i];
    if (m->actuator_biastype[i] != mjBIAS_AFFINE) continue;
    const mjtNum* bias = m->actuator_biasprm + i * mjNBIAS;
    added[dof] -= gear * gear * (h * h * bias[1] + per_damping * bias[2]);
  }
  return added;
}

/// Another pose within the joints' ranges, the same ones for each model.
void Draw(const mjModel* m, std::minstd_rand& random, mjtNum* position) {
  for (int i = 0; i < m->njnt; ++i) {
    const bool limited = m->jnt_limited[i], hinge = m->jnt_type[i] == mjJNT_HINGE;
    const double share = static_cast<double>(random()) / std::minstd_rand::max();
    const double lower = limited ? m->jnt_range[2 * i] : -mjPI;
    const double upper = limited ? m->jnt_range[2 * i + 1] : mjPI;
    if (hinge) position[m->jnt_qposadr[i]] = lower + share * (upper - lower);
  }
}

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
Asked ForSlope(double slope, double inertia, double h) {
  return {
      2 * slope * h, inertia / (2 * slope),
      fmt::format("friction rises over speed by up to {:.4g} N.m.s/rad (N.s/m), too steeply for an "
                  "effective inertia of {:.3g} kg.m^2 (kg) at timestep {}",
                  slope, inertia, h)};
}

/// How far the bristle winds up before it slides: level h^2 / (A M).
Asked ForWindUp(const JointFriction& friction, const BristleShape& bristles, double inertia,
                double h, JointKind kind) {
  const double level = friction.HoldingLevel();
  const double allowed = kind == JointKind::rotary ? kLargestWindUp : kLargestLinearWindUp;
  const double needed = level * h * h / (bristles.stiffness * allowed);
  return {
      needed, h * std::sqrt(inertia / needed),
      fmt::format("friction holds up to {:.3g} on an effective inertia of {:.3g} at timestep {}; "
                  "it would give way by {:.3g} {} before it slides, at most {} are allowed",
                  level, inertia, h, allowed * needed / inertia, kPositionUnit.For(kind), allowed)};
}

/// An explicit step carries a law's own bristle while (stiffness + 2 damping) in units of M/h^2 and
/// M/h is at most that of UnitBristle.
Asked ForBristle(const Bristle& bristle, double inertia, double h) {
  constexpr double carried = kBristleStiffness + 2 * kBristleDamping;
  // largest step: stiffness h^2 + 2 damping h = carried M
  const double b = bristle.damping;
  const double longest =
      carried * inertia / (b + std::sqrt(b * b + carried * inertia * bristle.stiffness));
  return {
      h * (bristle.stiffness * h + 2 * b) / carried, longest,
      fmt::format("bristle_stiffness is {} and bristle_damping {} on an effective inertia of "
                  "{:.3g} at timestep {}; the step would be unstable unless the bristle is softer",
                  bristle.stiffness, b, inertia, h)};
}

}  // namespace

bool DampsImplicitly(const mjModel* m, int integrator) {
  if (integrator == mjINT_EULER) return !(m->opt.disableflags & mjDSBL_EULERDAMP);
  return integrator != mjINT_RK4;
}

std::vector<double> StiffestDrives(const mjModel* m, int integrator,
                                   const std::vector<double>& slopes) {
  // most models: the eigenvalues' sum, in which the compiler at first knows no inertia, is small
  std::vector<double> stiffest(static_cast<size_t>(m->ntree), 0);
  const Eigen::VectorXd added = Added(m, integrator, slopes);
  double sum = 0;
  for (int dof = 0; dof < m->nv; ++dof) {
    const double inertia = EffectiveInertia(m, dof);
    if (inertia > 0) sum += std::max(0.0, added[dof]) / inertia;
  }
  if (sum <= kMinor || IsDiscrete(integrator) || integrator == mjINT_RK4) return stiffest;

  OverPoses(m, [&](const Eigen::MatrixXd& inertia) {
    for (int tree = 0; tree < m->ntree; ++tree) {
      const int first = m->tree_dofadr[tree], size = m->tree_dofnum[tree];
      const double mode =
          StiffestMode(added.segment(first, size), inertia.block(first, first, size, size));
      stiffest[tree] = std::max(stiffest[tree], mode);
    }
  });
  return stiffest;
}

double StiffestMode(const Eigen::VectorXd& added, const Eigen::MatrixXd& inertia) {
  const Eigen::MatrixXd diagonal = added.asDiagonal();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(
      diagonal, inertia, Eigen::EigenvaluesOnly | Eigen::Ax_lBx);
  return modes.eigenvalues().maxCoeff();
}

void OverPoses(const mjModel* m, const std::function<void(const Eigen::MatrixXd& inertia)>& look) {
  // data of a model with plugins would ask for this instance again
  const std::unique_ptr<mjModel, void (*)(mjModel*)> bare(mj_copyModel(nullptr, m), mj_deleteModel);
  bare->nplugin = 0;
  const std::unique_ptr<mjData, void (*)(mjData*)> d(mj_makeData(bare.get()), mj_deleteData);
  Eigen::MatrixXd inertia(m->nv, m->nv);
  std::minstd_rand random;
  for (int pose = 0; pose < kPoses; ++pose) {
    if (pose > 0) Draw(m, random, d->qpos);
    mj_kinematics(bare.get(), d.get());
    mj_comPos(bare.get(), d.get());
    mj_makeM(bare.get(), d.get());
    mj_fullM(bare.get(), d.get(), inertia.data());
    look(inertia);
  }
}

std::array<Asked, 2> AskedOf(const mjModel* m, int joint, const SteppedFriction& stepped,
                             const BristleShape& bristles) {
  const JointFriction& friction = stepped.friction;
  const double inertia = stepped.inertia, h = m->opt.timestep;
  const bool slides = m->jnt_type[joint] == mjJNT_SLIDE;
  const JointKind kind = slides ? JointKind::linear : JointKind::rotary;
  return {ForSlope(stepped.OwnSlope(), inertia, h),
          friction.own_bristle() ? ForBristle(*friction.own_bristle(), inertia, h)
                                 : ForWindUp(friction, bristles, inertia, h, kind)};
}

void CheckJoint(const mjModel* m, int joint, const SteppedFriction& friction,
                const BristleShape& bristles, const Place& place) {
  const int type = m->jnt_type[joint];
  if (type != mjJNT_HINGE && type != mjJNT_SLIDE) {
    Refuse(place, "{} is neither hinge nor slide; friction acts on these alone",
           JointName(m, joint));
  }

  // the compiler asks once before it knows the inertia, and again after
  if (friction.inertia == 0) return;
  for (const Asked& asked : AskedOf(m, joint, friction, bristles)) {
    if (asked.inertia <= friction.inertia) continue;
    Refuse(place, "{}: add an armature of {:.3g} or take a timestep of at most {:.3g} s", asked.why,
           RoundUp(asked.inertia - friction.inertia), RoundDown(asked.timestep));
  }
}

void CheckDamping(const mjModel* m, int joint, const SteppedFriction& friction,
                  const Place& place) {
  if (friction.viscous == Viscous::by_plugin) return;
  // the flag leaves out all dampers
  if (m->opt.disableflags & mjDSBL_DAMPER) {
    if (m->dof_damping[m->jnt_dofadr[joint]] == 0) return;
    Refuse(place,
           "the model's flag damper is disabled, and with it friction's viscous part, which is "
           "the joint's damping; enable it");
  }
  if (DampsImplicitly(m, m->opt.integrator)) return;
  const double slope = friction.friction.SteepestSlope();
  const Asked asked = ForSlope(slope, friction.inertia, m->opt.timestep);
  if (asked.inertia <= friction.inertia) return;
  Refuse(
      place,
      "{}, and its integrator takes damping explicitly: take the integrator implicitfast (attach "
      "--integrator implicitfast), {:.3g} more armature, or a timestep of at most {:.3g} s",
      asked.why, RoundUp(asked.inertia - friction.inertia), RoundDown(asked.timestep));
}

void CheckDrive(const mjModel* m, int joint, double drive, const std::vector<double>& slopes,
                const Place& place) {
  // beside stiffer ones bristles no longer soften
  if (!ShakesBeside(drive)) return;
  const double h = m->opt.timestep;
  const int tree = m->dof_treeid[m->jnt_dofadr[joint]];
  const bool implicit_helps = StiffestDrives(m, mjINT_IMPLICITFAST, slopes)[tree] <= kStiffestDrive;
  Refuse(place,
         "servos are too stiff for timestep {}: their h^2 kp + 2 h kv over the inertia, with the "
         "joints' "
         "springs and friction's slopes, is up to {:.3g}, above {}, so that the joint may shake "
         "instead of resting; take {}a timestep of at "
         "most {:.3g} s (attach --timestep) or more armature (--armature)",
         h, drive, kStiffestDrive,
         implicit_helps ? "the integrator implicitfast (attach --integrator implicitfast), " : "",
         RoundDown(h * kStiffestDrive / drive));
}

}  // namespace warmjoint
