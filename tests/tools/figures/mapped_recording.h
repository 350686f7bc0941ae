// A recording whose torque ripples with the motor's angle, and an estimate that knows it.
#pragma once

#include "tests/tools/figures/warm_recording.h"
#include "tools/figures/fit_view.h"

namespace warmjoint::figures {

/// Weights over motor angle: a wave of 2 N.m about 0, once a turn.
inline FrictionMap WaveMap() {
  FrictionMap map;
  map.axes = {{MapQuantity::motor_position, CircleAxis(2 * M_PI, 36)}};
  for (double centre : map.axes[0].kernels.centres) map.weights.push_back(2 * std::sin(centre));
  return map;
}

/// WarmRecording through a gear of 1.3 at three speeds, with WaveMap in truth and estimate.
struct MappedRecording : WarmRecording {
  MappedRecording() {
    measurements.gear = 1.3;
    estimate.friction->maps = {WaveMap()};
    for (Segment& segment : selection.segments) {
      const double speeds[] = {0.2, 0.5, 0.9};
      const double speed = speeds[segment.begin / 40 % 3];
      segment.velocity = segment.velocity > 0 ? speed : -speed;
      measurements.velocity.segment(segment.begin, segment.end - segment.begin)
          .setConstant(segment.velocity);
    }
    for (Eigen::Index i = 1; i < measurements.size(); ++i) {
      // slower on the way back, so that every speed meets every angle
      const double step = measurements.velocity[i - 1];
      measurements.position[i] = measurements.position[i - 1] + (step > 0 ? 1 : 0.6) * step;
    }
    prediction = PredictFriction(*estimate.friction, measurements);
    RandomStream random({8, 0}, Stream::test);
    for (Eigen::Index i = 0; i < measurements.size(); ++i) {
      const double motor = measurements.gear * measurements.position[i];
      // sin at the centres, smoothed by kernels one spacing wide, still has 98 % of its height
      measurements.torque[i] = PlainForce(i) + 2 * std::sin(motor) + 0.1 * random.Normal();
    }
  }

  FitView View() const { return MakeFitView(measurements, selection, estimate); }

 private:
  /// Law and warming alone.
  double PlainForce(Eigen::Index i) const {
    const double v = measurements.velocity[i];
    return 5 * v + 15 * Sign(v) + Sign(v) * prediction.energy[i];
  }
};

}  // namespace warmjoint::figures
