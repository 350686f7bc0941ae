#include "identification/holdout/predict_torque.h"

#include "models/foundation/low_pass.h"
#include "models/recording/measurements.h"

namespace warmjoint {

TorquePrediction PredictTorque(const TorqueModel& model, const Measurements& m, Selection asked,
                               const CourseStart& start) {
  TorquePrediction predicted{{}, std::move(asked), PredictFriction(model.friction, m, start)};
  // friction, and inertia where the log has an acceleration
  predicted.torque = predicted.friction.force;
  if (model.inertia && m.acceleration) predicted.torque += *model.inertia * *m.acceleration;

  // gravity where it is known
  if (model.gravity) {
    predicted.torque += model.gravity->Torque(m.position);
    for (Eigen::Index i = 0; i < m.size(); ++i) {
      bool& keep = predicted.known.keep[i];
      keep = keep && model.gravity->Covers(m.position[i]);
    }
  }

  // the log holds the torque as it comes through its lag
  if (model.lag) predicted.torque = LowPass(m.time, predicted.torque, *model.lag);
  return predicted;
}

}  // namespace warmjoint
