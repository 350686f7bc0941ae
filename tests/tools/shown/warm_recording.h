// A recording of warm friction and one that ripples with the motor's angle, and estimates of them, for tests of pictures.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/recording.h>

#include "identification/forward/log_trajectory.h"
#include "models/foundation/random_stream.h"
#include "tools/shown/fit_view.h"

namespace warmjoint::shown {

/// Twenty minutes at 1 Hz: 20 s at each speed, the sign alternating; Table I's friction, 0.5 N.m of
/// noise. The estimate is the truth.
struct WarmRecording {
  LogSamples measurements;
  Selection selection;
  Estimate estimate;
  Prediction prediction;

  WarmRecording() {
    constexpr Eigen::Index kSamples = 1200, kHold = 20;
    RandomStream random({7, 0}, Stream::test);
    measurements.source = "folder/warm.csv";
    measurements.time = Eigen::VectorXd::LinSpaced(kSamples, 0, kSamples - 1);
    measurements.position = measurements.velocity = Eigen::VectorXd::Zero(kSamples);
    selection.keep.setConstant(kSamples, true);
    for (Eigen::Index begin = 0; begin < kSamples; begin += kHold) {
      const double sign = (begin / kHold) % 2 == 0 ? 1 : -1;
      const double speed = sign * random.Uniform(0.1, 1);
      measurements.velocity.segment(begin, kHold).setConstant(speed);
      selection.segments.push_back({begin, begin + kHold, speed});
    }
    for (Eigen::Index i = 1; i < kSamples; ++i) {
      measurements.position[i] = measurements.position[i - 1] + measurements.velocity[i - 1];
    }
    Identify(random);
  }

  FitView View() const { return MakeFitView(measurements, selection, estimate); }

 private:
  void Identify(RandomStream& random) {
    estimate.friction = Friction{};
    estimate.friction->parameters = {{"viscous", 5}, {"coulomb", 15}};
    estimate.friction->thermal = Thermal{-3, 600};
    prediction = PredictFriction(*estimate.friction, measurements);
    measurements.torque = prediction.force;
    for (double& torque : measurements.torque) torque += 0.5 * random.Normal();

    estimate.identifier = "energy-ml";
    estimate.message = "joint maximum likelihood";
    estimate.parameters = {
        {"viscous", 5, "N.m.s/rad", 0.06, std::array{4.88, 5.12}},
        {"coulomb", 15, "N.m", 0.1, std::array{14.8, 15.2}},
        {"thermal_gain", -3, "N.m/W", 0.05, std::array{-3.1, -2.9}},
        {"thermal_time_constant", 600, "s", 12, std::array{576.0, 624.0}},
    };
    // as of parameters that do not depend on each other
    ParameterCovariance covariance{{}, Eigen::MatrixXd::Zero(4, 4)};
    for (const EstimatedParameter& one : estimate.parameters) {
      const auto i = static_cast<Eigen::Index>(covariance.parameters.size());
      covariance.matrix(i, i) = *one.std * *one.std;
      covariance.parameters.push_back(one.name);
    }
    estimate.covariance = covariance;
    estimate.metrics = ComputeMetrics(measurements.torque, prediction.force, 4, 4);
  }
};

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

 private:
  /// Law and warming alone.
  double PlainForce(Eigen::Index i) const {
    const double v = measurements.velocity[i];
    return 5 * v + 15 * Sign(v) + Sign(v) * prediction.energy[i];
  }
};

}  // namespace warmjoint::shown
