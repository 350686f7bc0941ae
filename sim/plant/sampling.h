// How a signal gets into the log: sensor noise, low-pass, storage.
#pragma once

#include <warmjoint/simulation.h>

#include <Eigen/Core>
#include <optional>

#include "models/foundation/low_pass.h"
#include "models/foundation/random_stream.h"
#include "scenarios/scenario.h"

namespace warmjoint {

/// Order of the causal Butterworth low-pass on the sensor readings.
inline constexpr int kSensorFilterOrder = 4;

/// How long that delays what changes slowly, times its cutoff: 2 (cos 22.5 deg + cos 67.5 deg) / (2 pi).
inline constexpr double kSensorFilterDelay = 0.4159;

/// Number of sensor readings, from t = 0 on, behind `stored` samples.
Eigen::Index SensorReadings(const Sampling& sampling, Eigen::Index stored);

/// Standard deviation of the noise on a stored sample over that on a sensor reading: the root of
/// the energy of the impulse response from readings to samples, its mean over the samples where
/// they lie differently between the readings. 1 without a filter and between no readings.
double NoiseLeft(const Sampling& sampling, Eigen::Index stored);

/// One signal on its way: reading j at t = j / sensor_rate gets white noise, passes the low-pass
/// (where cutoff > 0; settled on the first reading), and is stored at k / rate. A stored sample
/// that falls between two readings lies on the line between them.
class LoggedSignal {
 public:
  /// noise: standard deviation on each reading, from `random`; stored: number of samples.
  LoggedSignal(const Sampling& sampling, double noise, const RandomStream& random,
               Eigen::Index stored);

  /// The next reading, in order of time.
  void Read(double value);

  /// The samples, [stored]; all readings must have been made.
  const Eigen::VectorXd& samples() const { return samples_; }

 private:
  double readings_per_sample_;
  double noise_;
  RandomStream random_;
  std::optional<BiquadCascade> filter_;
  Eigen::Index reading_ = 0;  // number of the next reading
  Eigen::Index next_ = 0;     // number of the next sample
  double last_ = 0;           // reading before, filtered
  Eigen::VectorXd samples_;
};

/// What sensors read of a joint at once.
struct Reading {
  double position = 0;  // rad or m
  double velocity = 0;  // rad/s or m/s
  double torque = 0;    // N.m or N
  double rigid = 0;     // of the torque: weight and inertia, N.m or N
  double load = 0;      // that the joint transmits, N.m or N
};

/// The signals of a joint, each with the noise of the scenario from a stream of its own; the rigid part and the load,
/// which is logged where friction depends on it, without noise.
class SensorLog {
 public:
  /// stored: number of samples.
  SensorLog(const Scenario& scenario, RandomKey key, Eigen::Index stored);

  /// Whether all readings have been made.
  bool Full() const { return left_ == 0; }
  /// The next reading. Must not be full.
  void Read(const Reading& reading);
  /// Time, position, velocity, torque and, where it is logged, load of the stored samples; their rigid part.
  void WriteTo(Simulation& recording) const;

 private:
  double rate_;        // Hz, stored
  Eigen::Index left_;  // readings to come
  LoggedSignal position_;
  LoggedSignal velocity_;
  LoggedSignal torque_;
  LoggedSignal rigid_;
  std::optional<LoggedSignal> load_;
};

}  // namespace warmjoint
