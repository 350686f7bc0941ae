#include "identification/holdout/predict_torque.h"

#include "identification/fit_data.h"
#include "identification/forward/log_trajectory.h"
#include "identification/physical_bounds.h"
#include "models/foundation/low_pass.h"

namespace warmjoint {

TorquePrediction PredictTorque(const TorqueModel& model, const LogSamples& m, Selection asked,
                               const ThermalStart& start) {
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

TorqueModel ModelOf(const Fit& fit) {
  TorqueModel model{fit.friction, fit.gravity, fit.inertia};
  if (fit.torque_lag) model.lag = fit.torque_lag->time_constant;
  return model;
}

std::optional<Metrics> Evaluate(const Fit& fit, const LogSamples& measurements, Selection test,
                                const ThermalStart& start) {
  if (!GivesFriction(fit)) return std::nullopt;
  const Friction& friction = fit.friction;
  const TorquePrediction predicted =
      PredictTorque(ModelOf(fit), measurements, std::move(test), start);
  if (predicted.known.count() == 0) return std::nullopt;

  // all parameters that the model has, weights of kernels included
  auto parameters = friction.parameters.size() + (friction.thermal ? 2 : 0);
  for (const FrictionMap& map : friction.maps) parameters += map.weights.size();
  if (fit.gravity) parameters += fit.gravity->values.size();
  if (fit.inertia) ++parameters;
  if (fit.torque_lag) ++parameters;
  return ComputeMetrics(Kept(measurements.torque, predicted.known),
                        Kept(predicted.torque, predicted.known), static_cast<int>(parameters),
                        fit.effective_parameters);
}

}  // namespace warmjoint
