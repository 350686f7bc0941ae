#include "sim/plugin/friction_sensors.h"

#include <algorithm>

namespace warmjoint::inline sim {

void FrictionSensors::Ask(const mjModel* m, mjData* d, const BoundJoints& bound, bool off) {
  // sensors are told at the stage of positions, and written by the step that follows
  asked_ = !off;
  if (!off) return;
  sensed_.assign(kSensed * bound.joints().size(), 0);
  Write(m, d, bound);
}

void FrictionSensors::Note(const mjModel* m, mjData* d, const BoundJoints& bound,
                           const JointRows& rows) {
  if (!asked_) return;
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
  for (const int sensor : bound.sensors()) {
    mjtNum* data = d->sensordata + m->sensor_adr[sensor];
    std::copy(sensed_.begin(), sensed_.end(), data);

    // the engine clips what stands there at the stage of positions
    const double most = m->sensor_cutoff[sensor];
    if (most <= 0) continue;
    for (size_t i = 0; i < sensed_.size(); ++i) data[i] = std::clamp(data[i], -most, most);
  }
}

}  // namespace warmjoint::inline sim
