#include "sim/plugin/friction_reports.h"

#include <algorithm>
#include <cstdint>
#include <string>

#include "models/foundation/bad_input.h"
#include "sim/plugin/plugin_instances.h"
#include "sim/plugin/stability.h"

namespace warmjoint {

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

void FrictionSensors::Ask(const mjModel* m, mjData* d, const BoundJoints& bound, bool off) {
  // sensors are told at the stage of positions, and written by the step that follows
  asked_ = !off;
  if (!off) return;
  sensed_.assign(kSensed * bound.joints().size(), 0);
  Write(m, d, bound);
}

void FrictionSensors::WriteStep(const mjModel* m, mjData* d, const BoundJoints& bound,
                                const JointRows& rows) {
  asked_ = false;
  const std::vector<BoundJoint>& joints = bound.joints();

  // force, heat, its rise of temperature, loss, and whether it holds
  sensed_.clear();
  for (size_t i = 0; i < joints.size(); ++i) {
    const auto [first, second] = rows.energies(i);
    const double energy = first + second;
    const double per_temperature = joints[i].friction.level_per_temperature();
    const double rise = per_temperature != 0 ? energy / per_temperature : 0;
    const double held = rows.slides(i) ? 0 : 1;
    for (const double value : {-rows.force(i), energy, rise, rows.loss(i), held}) {
      sensed_.push_back(value);
    }
  }
  Write(m, d, bound);
}

void FrictionSensors::Write(const mjModel* m, mjData* d, const BoundJoints& bound) const {
  for (const auto& [sensor, joint] : bound.sensors()) {
    // of one joint, or of all
    mjtNum* data = d->sensordata + m->sensor_adr[sensor];
    const auto begin = sensed_.begin() + static_cast<std::ptrdiff_t>(kSensed * joint.value_or(0));
    const size_t size = joint ? kSensed : sensed_.size();
    std::copy_n(begin, size, data);

    // the engine clips what stands there at the stage of positions
    const double most = m->sensor_cutoff[sensor];
    if (most <= 0) continue;
    for (size_t i = 0; i < size; ++i) data[i] = std::clamp(data[i], -most, most);
  }
}

}  // namespace warmjoint
