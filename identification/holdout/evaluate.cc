#include "identification/holdout/evaluate.h"

#include <warmjoint/estimate.h>

#include "identification/fit_data.h"
#include "identification/holdout/predict_torque.h"
#include "identification/physical_bounds.h"

namespace warmjoint {

TorqueModel ModelOf(const Fit& fit) {
  TorqueModel model{fit.friction, fit.gravity, fit.inertia};
  if (fit.torque_lag) model.lag = fit.torque_lag->time_constant;
  return model;
}

std::optional<Metrics> Evaluate(const Fit& fit, const Measurements& measurements, Selection test,
                                const CourseStart& start) {
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
