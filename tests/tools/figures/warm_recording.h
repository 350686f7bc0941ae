// A recording of warm friction and an estimate of it, for tests of pictures.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/recording.h>

#include "models/foundation/random_stream.h"
#include "models/recording/measurements.h"

namespace warmjoint::figures {

/// Twenty minutes at 1 Hz: 20 s at each speed, the sign alternating; Table I's friction, 0.5 N.m of
/// noise. The estimate is the truth.
struct WarmRecording {
  Measurements measurements;
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

}  // namespace warmjoint::figures
