#include "identification/holdout/hold_out.h"

#include "identification/fit_data.h"
#include "identification/forward/predict.h"

namespace warmjoint::inline identification {
namespace {

/// The first n samples.
Measurements Head(const Measurements& all, Eigen::Index n) {
  Measurements head = all;
  for (Eigen::VectorXd* column : {&head.time, &head.position, &head.velocity, &head.torque}) {
    column->conservativeResize(std::min(n, column->size()));
  }
  std::erase_if(head.starts, [n](Eigen::Index start) { return start >= n; });
  for (auto* column : {&head.motor_position, &head.load, &head.temperature}) {
    if (*column) (*column)->conservativeResize(n);
  }
  return head;
}

Selection Head(const Selection& all, Eigen::Index n) {
  Selection head{all.keep.head(n), {}};
  for (Segment segment : all.segments) {
    if (segment.begin >= n) break;
    segment.end = std::min(segment.end, n);
    head.segments.push_back(segment);
  }
  return head;
}

/// Figures of an estimate's friction on the samples that `test` keeps. initial_energy: E at the
/// first sample, N.m or N.
std::optional<Metrics> Evaluate(const Estimate& estimate, const Measurements& measurements,
                                Selection test, double initial_energy) {
  if (!estimate.friction) return std::nullopt;
  Eigen::VectorXd predicted =
      PredictFriction(*estimate.friction, measurements, initial_energy).force;
  auto parameters = estimate.friction->parameters.size() + (estimate.friction->thermal ? 2 : 0);
  for (const FrictionMap& map : estimate.friction->maps) parameters += map.weights.size();

  // gravity where the fit knows it
  if (estimate.gravity) {
    predicted += estimate.gravity->Torque(measurements.position);
    parameters += estimate.gravity->values.size();
    for (Eigen::Index i = 0; i < measurements.size(); ++i) {
      test.keep[i] = test.keep[i] && estimate.gravity->Covers(measurements.position[i]);
    }
  }
  if (test.count() == 0) return std::nullopt;
  const auto d = static_cast<int>(parameters);
  return ComputeMetrics(Kept(measurements.torque, test), Kept(predicted, test), d,
                        estimate.metrics ? estimate.metrics->effective_parameters : d);
}

}  // namespace

std::optional<Metrics> HoldOut(const Identifier& identifier, const IdentifierInput& input,
                               double fraction) {
  // the first sample of the test part
  const Measurements& all = input.measurements;
  const double duration = all.time[all.size() - 1] - all.time[0];
  const double split = all.time[0] + (1 - fraction) * duration;
  const Eigen::Index n = (all.time.array() < split).count();
  if (n < 2) return std::nullopt;

  const Measurements training = Head(all, n);
  const Selection training_selection = Head(input.selection, n);
  const Estimate estimate =
      identifier.identify({training, training_selection, input.options, input.random});

  Selection test = input.selection;
  test.keep.head(n) = false;
  const EstimatedParameter* start = estimate.Find("initial_energy");
  return Evaluate(estimate, all, test, start ? start->value : 0);
}

std::optional<Metrics> HoldOut(const Identifier& identifier, const IdentifierInput& input,
                               const Measurements& other, const Selection& other_selection) {
  constexpr double cold = 0;
  return Evaluate(identifier.identify(input), other, other_selection, cold);
}

}  // namespace warmjoint::inline identification
