#include "identification/holdout/evaluate.h"

#include "identification/fit_data.h"
#include "identification/inference/inference.h"
#include "models/recording/course_of.h"

namespace warmjoint::inline identification {

std::optional<Metrics> Evaluate(const Fit& fit, const Measurements& measurements, Selection test,
                                const CourseStart& start) {
  if (!Infer(fit).gives_friction) return std::nullopt;
  const FrictionDescription& friction = fit.friction;
  Eigen::VectorXd predicted = PredictFriction(friction, measurements, start).force;
  auto parameters = friction.parameters.size() + (friction.thermal ? 2 : 0);
  for (const FrictionMap& map : friction.maps) parameters += map.weights.size();

  // gravity where the fit knows it
  if (fit.gravity) {
    predicted += fit.gravity->Torque(measurements.position);
    parameters += fit.gravity->values.size();
    for (Eigen::Index i = 0; i < measurements.size(); ++i) {
      test.keep[i] = test.keep[i] && fit.gravity->Covers(measurements.position[i]);
    }
  }
  if (test.count() == 0) return std::nullopt;
  return ComputeMetrics(Kept(measurements.torque, test), Kept(predicted, test),
                        static_cast<int>(parameters), fit.effective_parameters);
}

}  // namespace warmjoint::inline identification
