#include <cmath>

#include "models/foundation/bad_input.h"
#include "models/friction/along_motion.h"
#include "models/friction/friction_json.h"
#include "sim/plant/plant.h"
#include "sim/plant/velocity_drive.h"

namespace warmjoint {
namespace {

/// Planned motion at samples.
struct SampledPlan {
  Eigen::VectorXd time;          // [N] s
  Eigen::VectorXd velocity;      // [N] rad/s or m/s
  Eigen::VectorXd position;      // [N] rad or m
  Eigen::VectorXd acceleration;  // [N] rad/s^2 or m/s^2
  /// [N] rad/s or m/s, as of JointTrajectory; empty where speeds change at samples alone
  Eigen::VectorXd mean_speed{}, loss_velocity{};
};

/// Means over the steps within which segments end: losses follow the speed, not the samples. rate: Hz
void FollowSwitches(const std::vector<MotionSegment>& plan, double rate, SampledPlan& samples) {
  constexpr double kAtSample = 1e-6;  // of a step
  // which share of a step is moved at which speed, where a segment ends within it
  Eigen::VectorXd speed = samples.velocity.cwiseAbs(), square = samples.velocity.cwiseAbs2();
  bool within = false;
  double end = 0;
  for (size_t s = 0; s + 1 < plan.size(); ++s) {
    end += plan[s].duration;
    const double place = end * rate, whole = std::floor(place + kAtSample);
    const auto i = static_cast<Eigen::Index>(whole);
    if (i >= speed.size()) break;
    if (place - whole < kAtSample) continue;
    const double before = plan[s].velocity, behind = plan[s + 1].velocity;
    const double share = 1 - (place - whole);
    speed[i] += share * (std::abs(behind) - std::abs(before));
    square[i] += share * (behind * behind - before * before);
    within = true;
  }

  // losses are as of a velocity whose square is the mean over mean speed
  if (!within) return;
  samples.loss_velocity = Eigen::VectorXd::Zero(speed.size());
  for (Eigen::Index i = 0; i < speed.size(); ++i) {
    if (speed[i] == 0) continue;
    samples.loss_velocity[i] = std::copysign(square[i] / speed[i], samples.velocity[i]);
  }
  samples.mean_speed = std::move(speed);
}

SampledPlan SamplePlan(const std::vector<MotionSegment>& plan, double start, double rate,
                       double duration) {
  const auto n = static_cast<Eigen::Index>(std::llround(duration * rate));
  SampledPlan samples{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n),
                      Eigen::VectorXd::Zero(n)};

  // a sample on a boundary belongs to the segment that begins there, whatever the rounding
  const double tolerance = 1e-6 / rate;
  size_t segment = 0;
  double begin = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double time = static_cast<double>(i) / rate;
    while (segment + 1 < plan.size() && time >= begin + plan[segment].duration - tolerance) {
      start += plan[segment].velocity * plan[segment].duration;
      begin += plan[segment].duration;
      ++segment;
    }
    samples.time[i] = time;
    samples.velocity[i] = plan[segment].velocity;
    samples.position[i] = start + plan[segment].velocity * (time - begin);
  }
  FollowSwitches(plan, rate, samples);
  return samples;
}

/// Longest step of the formulas where speeds change by ramps, s.
constexpr double kFinestStep = 0.002;

/// Samples of each stored one: 1 where speeds jump.
int PartsOfStep(const Scenario& scenario) {
  if (scenario.controller.acceleration == 0 && !FollowsCorners(scenario.motion)) return 1;
  return static_cast<int>(std::ceil(1 / (scenario.sampling.rate * kFinestStep)));
}

/// The same of a velocity with ramps, from rest.
SampledPlan SampleRamps(VelocityReference reference, double start, double rate, double duration) {
  constexpr double kBeside = 1e-7;  // s
  VelocityReference before = reference, behind = reference;
  const auto n = static_cast<Eigen::Index>(std::llround(duration * rate));
  SampledPlan samples{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n),
                      Eigen::VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    samples.time[i] = static_cast<double>(i) / rate;
    samples.velocity[i] = reference.Velocity(samples.time[i]);

    // at a corner, between the slopes of both sides
    before.Velocity(samples.time[i] - kBeside);
    behind.Velocity(samples.time[i] + kBeside);
    samples.acceleration[i] = 0.5 * (before.acceleration() + behind.acceleration());
    samples.position[i] = start;
    if (i > 0) {
      samples.position[i] =
          samples.position[i - 1] + (samples.velocity[i - 1] + samples.velocity[i]) / (2 * rate);
    }
  }
  return samples;
}

/// values plus white noise of the given standard deviation; no numbers are drawn for 0.
Eigen::VectorXd WithNoise(Eigen::VectorXd values, double deviation, RandomStream random) {
  if (deviation == 0) return values;
  for (double& value : values) value += deviation * random.Normal();
  return values;
}

class IdealPlant : public Plant {
 public:
  explicit IdealPlant(const Scenario& scenario) : scenario_(scenario) {
    // what this plant cannot carry out
    CheckFriction(scenario.friction, {scenario.name});
    if (scenario.friction.second_thermal && scenario.disturbances.second_heat) {
      Refuse({scenario.name},
             "friction.thermal.second and disturbances.second_heat are both given; the joint has "
             "one second stage, so leave one out");
    }
    if (scenario.motion.travel.joint_limits) {
      Refuse({scenario.name},
             "the ideal plant has no robot, so the motion cannot travel between its joint limits; "
             "give the limits as numbers, or use the mujoco plant");
    }
  }

  Simulation Run(std::uint64_t realization, const RunWatch&) override {
    // friction along the motion, finer where speeds change by ramps
    const RandomKey key{scenario_.seed, realization};
    const int parts = PartsOfStep(scenario_);
    const double rate = parts * scenario_.sampling.rate;
    SampledPlan samples = Sample(rate, key);
    Prediction friction = AlongMotion(FrictionOfPlant())
                              .Predict(TrajectoryOf(samples, 1 / rate), {scenario_.initial_energy});
    RefusePush(samples, friction);

    // of which samples are stored
    for (Eigen::VectorXd* column :
         {&samples.time, &samples.velocity, &samples.position, &samples.acceleration,
          &friction.force, &friction.loss, &friction.energy}) {
      *column = (*column)(Eigen::seq(0, Eigen::last, parts)).eval();
    }

    // the log and the truth behind it
    Simulation recording;
    recording.measurements = Measure(samples, friction.force, key);
    Truth& truth = recording.truth;
    truth.friction = scenario_.friction;
    truth.initial_energy = scenario_.initial_energy;
    truth.torque_noise = scenario_.noise.torque;
    truth.plant = "ideal";
    truth.velocity = samples.velocity;
    truth.force = std::move(friction.force);
    truth.loss = std::move(friction.loss);
    truth.energy = std::move(friction.energy);
    const bool follows = FollowsCorners(scenario_.motion);
    DisturbLog(scenario_, realization, recording, samples.position,
               follows ? samples.acceleration : Eigen::VectorXd());
    return recording;
  }

 private:
  /// The planned motion. rate: Hz
  SampledPlan Sample(double rate, RandomKey key) const {
    const Motion& motion = scenario_.motion;
    const double duration = scenario_.duration, acceleration = scenario_.controller.acceleration;
    const double start = StartPosition(motion, {});
    // ramps follow corners, or segments with an acceleration; else speeds jump
    RandomStream random(key, Stream::motion);
    if (FollowsCorners(motion)) {
      const std::vector<VelocityCorner> corners = PlanCorners(motion, duration, random);
      return SampleRamps(VelocityReference::Through(corners, 1, 0), start, rate, duration);
    }
    const std::vector<MotionSegment> plan = PlanMotion(motion, duration, {}, random);
    if (acceleration == 0) return SamplePlan(plan, start, rate, duration);
    return SampleRamps(VelocityReference(plan, acceleration, 0), start, rate, duration);
  }

  /// Beyond that sample the model has left its domain.
  void RefusePush(const SampledPlan& samples, const Prediction& friction) const {
    const Eigen::Index at = friction.first_driving;
    if (at == samples.time.size()) return;
    Refuse(
        {scenario_.name},
        "at {:g} s friction drives the joint: at a velocity of {:g} the energy state {:g} exceeds "
        "the nominal friction, so that F = {:g} does not brake; move slower before, rest, or lower "
        "the thermal gain",
        samples.time[at], samples.velocity[at], friction.energy[at], friction.force[at]);
  }

  /// The load that the joint transmits, [N] N.m or N.
  Eigen::VectorXd Load(const Eigen::VectorXd& time) const {
    const LoadChange& change = scenario_.disturbances.load_change;
    return time.unaryExpr([&](double t) {
      // half a period without load, half a period with it
      return std::fmod(t, change.period) < change.period / 2 ? 0.0 : change.load;
    });
  }

  /// The friction that the joint has, disturbances included; the truth is told without them.
  Friction FrictionOfPlant() const {
    Friction friction = scenario_.friction;
    if (scenario_.disturbances.second_heat) {
      friction.second_thermal = scenario_.disturbances.second_heat;
    }
    return friction;
  }

  /// step: between the samples, s.
  JointTrajectory TrajectoryOf(const SampledPlan& samples, double step) const {
    const Disturbances& disturbances = scenario_.disturbances;
    // the motion, and what else friction follows
    JointTrajectory trajectory{samples.time, samples.velocity, samples.position};
    trajectory.step = step;
    trajectory.mean_speed = samples.mean_speed;
    trajectory.loss_velocity = samples.loss_velocity;
    trajectory.load = TransmittedLoad(samples);
    trajectory.ambient_rise = samples.time.unaryExpr(
        [&](double t) { return disturbances.ambient_temperature.RiseAt(t); });

    // what moves its level
    const AmbientDrift& drift = disturbances.ambient_drift;
    if (drift.amplitude != 0) {
      trajectory.level = drift.LevelAlong(samples.time);
    }
    if (disturbances.load_change.load != 0) {
      const Eigen::VectorXd growth = disturbances.load_change.gain * Load(samples.time).cwiseAbs();
      trajectory.level = trajectory.level.size() > 0 ? trajectory.level + growth : growth;
    }
    return trajectory;
  }

  /// Load of the scenario and gravity, [N] N.m or N.
  Eigen::VectorXd TransmittedLoad(const SampledPlan& samples) const {
    return Load(samples.time) + GravityAt(samples.position);
  }

  /// G(p) of Eq. (6), [N] N.m or N.
  Eigen::VectorXd GravityAt(const Eigen::VectorXd& position) const {
    const Gravity& gravity = scenario_.disturbances.gravity;
    return gravity.sine * position.array().sin() + gravity.cosine * position.array().cos();
  }

  Measurements Measure(const SampledPlan& samples, const Eigen::VectorXd& force,
                       RandomKey key) const {
    const Noise& noise = scenario_.noise;
    // what the log is of
    Measurements log;
    log.joint = scenario_.joint_kind;
    log.torque_unit = kTorqueUnit.For(scenario_.joint_kind);
    log.gear = scenario_.friction.gear;
    log.source = scenario_.name;

    // its columns with their noise
    log.time = samples.time;
    log.position = WithNoise(samples.position, noise.position, {key, Stream::position_noise});
    log.velocity = WithNoise(samples.velocity, noise.velocity, {key, Stream::velocity_noise});
    log.torque = WithNoise(force, noise.torque, {key, Stream::torque_noise});
    const Gravity& gravity = scenario_.disturbances.gravity;
    if (gravity.sine != 0 || gravity.cosine != 0) log.torque += GravityAt(samples.position);
    if (NeedsLoad(scenario_.friction)) {
      log.load = TransmittedLoad(samples);
    } else if (scenario_.disturbances.load_change.load != 0) {
      log.load = Load(samples.time);
    }
    return log;
  }

  const Scenario scenario_;
};

}  // namespace

std::unique_ptr<Plant> MakeIdealPlant(const Scenario& scenario) {
  return std::make_unique<IdealPlant>(scenario);
}

}  // namespace warmjoint
