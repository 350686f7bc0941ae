#include "sim/plugin/friction_reports.h"

#include <algorithm>
#include <cstdint>
#include <string>

#include "models/foundation/bad_input.h"
#include "sim/plugin/check_actuator.h"
#include "sim/plugin/check_joint.h"

namespace warmjoint::inline sim {

void WarnOfNumbers(const mjModel* m, mjData* d, int instance,
                   const std::vector<BoundJoint>& joints) {
  mjtNum& reported = d->plugin_state[m->plugin_stateadr[instance] + kReportsStep];
  // once after a reset
  if (reported != 0) return;
  for (const BoundJoint& joint : joints) {
    try {
      const Place place{JointName(m, joint.joint)};
      CheckJoint(m, joint.joint, joint.friction, BristlesOf(joint.instances), place);
      CheckDrive(m, joint.joint, joint.drive, place);
    } catch (const BadInput& refusal) {
      reported = 1;
      mju_warning("%s: at %g s the model is beyond what its step bears: %s", kFrictionPlugin,
                  d->time, refusal.what());
      return;
    }
  }
}

void WarnOfPush(const mjModel* m, mjData* d, int instance, const std::vector<BoundJoint>& joints,
                size_t place) {
  // a double counts 52 joints; those beyond share the last place
  const uint64_t bit = uint64_t{1} << std::min<size_t>(place, 51);
  mjtNum& reported = d->plugin_state[m->plugin_stateadr[instance] + kReportsPush];
  // once for each joint
  const auto before = static_cast<uint64_t>(reported);
  if (before & bit) return;
  reported = static_cast<mjtNum>(before | bit);
  const BoundJoint& joint = joints[place];
  const std::string name =
      joint.actuator < 0 ? JointName(m, joint.joint) : ActuatorName(m, joint.actuator);
  mju_warning(
      "%s: %s: at %g s friction would push the joint (its level is below 0 at %g rad/s or m/s); it "
      "is held at 0 from here on, and friction is outside its domain",
      kFrictionPlugin, name.c_str(), d->time, d->qvel[joint.dof]);
}

}  // namespace warmjoint::inline sim
