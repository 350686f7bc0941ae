#include "sim/plant/sampling.h"

#include <cmath>

#include "models/friction/level_terms.h"

namespace warmjoint {
namespace {

/// Where a stored sample lies among the readings.
struct Lie {
  Eigen::Index reading = 0;  // the last at or before it
  double beyond = 0;         // 0 on it, towards 1 on the next
};

Lie LieOf(Eigen::Index sample, double readings_per_sample) {
  // a sample that rounding puts beside a reading is on it
  constexpr double tolerance = 1e-6;
  const double exact = static_cast<double>(sample) * readings_per_sample;
  const double reading = std::floor(exact + tolerance);
  const double beyond = exact - reading;
  return {static_cast<Eigen::Index>(reading), beyond < tolerance ? 0.0 : beyond};
}

/// Of a sampling with a cutoff.
std::vector<Biquad> Filter(const Sampling& sampling) {
  return ButterworthLowPass(kSensorFilterOrder, sampling.cutoff, sampling.sensor_rate);
}

/// Sums over the impulse response g of the filter: g[i]^2 and g[i] g[i-1].
std::pair<double, double> ImpulseEnergy(const Sampling& sampling) {
  if (sampling.cutoff == 0) return {1, 0};
  BiquadCascade filter(Filter(sampling));
  // the response has decayed below rounding after some hundred periods of the cutoff
  const auto length = static_cast<long>(std::ceil(200 * sampling.sensor_rate / sampling.cutoff));
  double square = 0, neighbours = 0, last = 0;
  for (long i = 0; i < length; ++i) {
    const double g = filter.Step(i == 0 ? 1.0 : 0.0);
    square += g * g;
    neighbours += g * last;
    last = g;
  }
  return {square, neighbours};
}

}  // namespace

Eigen::Index SensorReadings(const Sampling& sampling, Eigen::Index stored) {
  const Lie last = LieOf(stored - 1, sampling.sensor_rate / sampling.rate);
  return last.reading + (last.beyond > 0 ? 2 : 1);
}

double NoiseLeft(const Sampling& sampling, Eigen::Index stored) {
  // between two readings, each with its share, whose noise the filter relates
  const auto [square, neighbours] = ImpulseEnergy(sampling);
  double variance = 0;
  for (Eigen::Index k = 0; k < stored; ++k) {
    const double f = LieOf(k, sampling.sensor_rate / sampling.rate).beyond;
    variance += ((1 - f) * (1 - f) + f * f) * square + 2 * f * (1 - f) * neighbours;
  }
  return std::sqrt(variance / static_cast<double>(stored));
}

LoggedSignal::LoggedSignal(const Sampling& sampling, double noise, const RandomStream& random,
                           Eigen::Index stored)
    : readings_per_sample_(sampling.sensor_rate / sampling.rate),
      noise_(noise),
      random_(random),
      samples_(stored) {
  if (sampling.cutoff > 0) filter_.emplace(Filter(sampling));
}

void LoggedSignal::Read(double value) {
  // the filter begins settled on the first reading
  if (reading_ == 0 && filter_) filter_->Settle(value);
  const double reading = noise_ > 0 ? value + noise_ * random_.Normal() : value;
  const double current = filter_ ? filter_->Step(reading) : reading;

  // every sample after the last reading and up to this one
  while (next_ < samples_.size()) {
    const Lie lie = LieOf(next_, readings_per_sample_);
    if (lie.reading == reading_ && lie.beyond == 0) {
      samples_[next_] = current;
    } else if (lie.reading + 1 == reading_) {
      samples_[next_] = last_ + lie.beyond * (current - last_);
    } else {
      break;
    }
    ++next_;
  }
  last_ = current;
  ++reading_;
}

SensorLog::SensorLog(const Scenario& scenario, RandomKey key, Eigen::Index stored)
    : rate_(scenario.sampling.rate),
      left_(SensorReadings(scenario.sampling, stored)),
      position_(scenario.sampling, scenario.noise.position, {key, Stream::position_noise}, stored),
      velocity_(scenario.sampling, scenario.noise.velocity, {key, Stream::velocity_noise}, stored),
      torque_(scenario.sampling, scenario.noise.torque, {key, Stream::torque_noise}, stored),
      rigid_(scenario.sampling, 0, {key, Stream::torque_noise}, stored) {
  if (!NeedsLoad(scenario.friction)) return;
  load_.emplace(scenario.sampling, 0, RandomStream({key, Stream::torque_noise}), stored);
}

void SensorLog::Read(const Reading& reading) {
  position_.Read(reading.position);
  velocity_.Read(reading.velocity);
  torque_.Read(reading.torque);
  rigid_.Read(reading.rigid);
  if (load_) load_->Read(reading.load);
  --left_;
}

void SensorLog::WriteTo(Simulation& recording) const {
  Measurements& measurements = recording.measurements;
  const Eigen::Index n = position_.samples().size();
  measurements.time.resize(n);
  for (Eigen::Index k = 0; k < n; ++k) measurements.time[k] = static_cast<double>(k) / rate_;
  measurements.position = position_.samples();
  measurements.velocity = velocity_.samples();
  measurements.torque = torque_.samples();
  recording.rigid = rigid_.samples();
  if (load_) measurements.load = load_->samples();
}

}  // namespace warmjoint
