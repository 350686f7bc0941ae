#include "sim/model/light_joints.h"

#include <fmt/ranges.h>

#include <cmath>
#include <optional>
#include <string>

#include "models/foundation/excerpt.h"
#include "models/foundation/parse_number.h"
#include "models/friction/joint_friction.h"
#include "sim/model/mujoco_handles.h"
#include "sim/plugin/check_joint.h"
#include "sim/plugin/stiff_drives.h"

namespace warmjoint::inline sim {
namespace {

/// What an armature may be, kg.m^2 or kg, and how short a step, s, before there is no remedy.
constexpr double kLargestArmature = 1e9;
constexpr double kShortestTimestep = 1e-9;

/// A give that is small beside the backlash of a robot's gears, rad or m.
constexpr double kSmallGive = 0.005;
constexpr double kSmallLinearGive = 0.0005;

/// One joint with its friction, on a copy of the model whose inertia and step may be tried out.
class Trial {
 public:
  Trial(mjModel* m, const FrictionForJoint& friction)
      : m_(m),
        joint_(mj_name2id(m, mjOBJ_JOINT, friction.joint.c_str())),
        friction_(friction.friction),
        inverse_(m->dof_invweight0[dof()]),
        uncoupled_(m->dof_M0[dof()]),
        timestep_(m->opt.timestep) {}

  double timestep() const { return timestep_; }
  double armature() const { return m_->dof_armature[dof()]; }

  /// Why the plugin refuses the joint with more inertia and another step; nothing where it does not.
  std::optional<std::string> Refusal(double added, double timestep) {
    // first the inertia of coupled joints, then that of joints with all others held
    m_->dof_invweight0[dof()] = inverse_ / (1 + added * inverse_);
    m_->dof_M0[dof()] = uncoupled_ + added;
    m_->opt.timestep = timestep;
    friction_.SetTimestep(timestep);
    std::optional<std::string> refusal;
    try {
      CheckJoint(m_, joint_, friction_, kLoneBristles, {JointName(m_, joint_)});
    } catch (const BadInput& refused) {
      refusal = refused.what();
    }
    // the copy is as it was for the next trial
    m_->dof_invweight0[dof()] = inverse_;
    m_->dof_M0[dof()] = uncoupled_;
    m_->opt.timestep = timestep_;
    return refusal;
  }

 private:
  int dof() const { return m_->jnt_dofadr[joint_]; }

  mjModel* m_;
  int joint_;
  JointFriction friction_;
  double inverse_;    // of the effective inertia at the reference pose, 1/(kg.m^2) or 1/kg
  double uncoupled_;  // the inertia with all other joints held, kg.m^2 or kg
  double timestep_;
};

/// The number of two digits next to `value`, on the side that `round` takes.
double TwoDigits(double value, double (*round)(double)) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
  return *ParseNumber(fmt::format("{:.2g}", round(value / unit) * unit));
}

/// The bound between `refused` and `accepted`, from the side of the accepted, to 1e-3.
template <typename Accepts>
double Bisect(double refused, double accepted, const Accepts& accepts) {
  while (std::abs(std::log(accepted / refused)) > 1e-3) {
    const double middle = std::sqrt(refused * accepted);
    (accepts(middle) ? accepted : refused) = middle;
  }
  return accepted;
}

/// The armature, of two digits, with which the joint carries its friction; nothing where none does.
std::optional<double> NeededArmature(Trial& trial) {
  const auto accepts = [&](double added) { return !trial.Refusal(added, trial.timestep()); };
  if (!accepts(kLargestArmature)) return std::nullopt;
  const double added = Bisect(1e-12, kLargestArmature, accepts);
  return TwoDigits(trial.armature() + added, [](double x) { return std::ceil(x); });
}

/// The longest step, of two digits, with which it does.
std::optional<double> NeededTimestep(Trial& trial) {
  const auto accepts = [&](double timestep) { return !trial.Refusal(0, timestep); };
  if (!accepts(kShortestTimestep)) return std::nullopt;
  const double longest = Bisect(trial.timestep(), kShortestTimestep, accepts);
  return TwoDigits(longest, [](double x) { return std::floor(x); });
}

}  // namespace

void RefuseLightJoints(const mjModel* model, const std::vector<FrictionForJoint>& frictions,
                       const Place& place) {
  const ModelPtr copy(mj_copyModel(nullptr, model));
  std::vector<std::string> reasons, armatures;
  double timestep = model->opt.timestep;
  bool shorter_helps = true;
  // each joint that the plugin would refuse, with what would let it pass
  for (const FrictionForJoint& friction : frictions) {
    Trial trial(copy.get(), friction);
    const auto reason = trial.Refusal(0, trial.timestep());
    if (!reason) continue;
    reasons.push_back(*reason);
    if (const auto armature = NeededArmature(trial)) {
      armatures.push_back(fmt::format("--armature {}={}", friction.joint, *armature));
    }
    const auto longest = NeededTimestep(trial);
    shorter_helps = shorter_helps && longest;
    if (longest) timestep = std::min(timestep, *longest);
  }

  // one refusal for all of them, with whichever remedies there are
  if (reasons.empty()) return;
  const std::string by_armature = fmt::format("{}", fmt::join(armatures, " "));
  const std::string by_timestep = shorter_helps ? fmt::format("--timestep {}", timestep) : "";
  const char* link = armatures.empty() || !shorter_helps ? "" : ", or ";
  Refuse(place, "{} of its joints cannot carry their friction; give {}{}{}. The first: {}",
         reasons.size(), by_armature, link, by_timestep, reasons.front());
}

namespace {

/// Of the joint that gives way most, and the armatures for those that give way by more than a little.
std::string NoticeOfGive(const mjModel* m, const std::vector<FrictionForJoint>& frictions,
                         const std::vector<double>& drives) {
  std::vector<std::string> armatures;
  std::string worst;
  double most = 0;
  for (const FrictionForJoint& friction : frictions) {
    const int joint = mj_name2id(m, mjOBJ_JOINT, friction.joint.c_str()),
              dof = m->jnt_dofadr[joint];
    const BristleShape bristles = BristlesOf(1, drives[m->dof_treeid[dof]]);
    const double give = WindUp(m, joint, JointFriction(friction.friction), bristles);
    // in units of a small give, so that hinges and slides compare
    const bool slides = m->jnt_type[joint] == mjJNT_SLIDE;
    const double share = give / (slides ? kSmallLinearGive : kSmallGive);
    if (share > most) {
      most = share;
      worst = fmt::format("'{}' by {:.2g} {}", friction.joint, 1000 * give, slides ? "mm" : "mrad");
    }
    if (share <= 1) continue;
    const double armature = m->dof_armature[dof] + EffectiveInertia(m, dof) * (share - 1);
    armatures.push_back(fmt::format("--armature {}={}", friction.joint,
                                    TwoDigits(armature, [](double x) { return std::ceil(x); })));
  }
  if (most == 0) return "";
  return fmt::format("joints give way elastically before they slide, most of all {}{}{}", worst,
                     armatures.empty() ? "" : "; for at most 5 mrad (0.5 mm) give ",
                     fmt::join(armatures, " "));
}

/// Of the first joint that drives may shake.
std::string NoticeOfDrive(const mjModel* m, const std::vector<FrictionForJoint>& frictions,
                          const std::vector<double>& drives) {
  for (const FrictionForJoint& friction : frictions) {
    const int joint = mj_name2id(m, mjOBJ_JOINT, friction.joint.c_str());
    const double drive = drives[m->dof_treeid[m->jnt_dofadr[joint]]];
    try {
      CheckDrive(m, joint, JointFriction(friction.friction), 1, drive, {JointName(m, joint)});
    } catch (const BadInput& refused) {
      return refused.what();
    }
  }
  return "";
}

}  // namespace

std::vector<std::string> NoticesOfHolding(const mjModel* m,
                                          const std::vector<FrictionForJoint>& frictions) {
  const std::vector<double> drives = StiffestDrives(m, m->opt.integrator);
  std::vector<std::string> notices{NoticeOfGive(m, frictions, drives),
                                   NoticeOfDrive(m, frictions, drives)};
  std::erase(notices, "");
  return notices;
}

}  // namespace warmjoint::inline sim
