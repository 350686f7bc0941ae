#include <algorithm>
#include <cmath>

#include "models/foundation/bad_input.h"
#include "models/friction/joint_friction.h"
#include "models/robots/robot_folder.h"
#include "sim/plant/plant.h"
#include "sim/plant/sampling.h"
#include "sim/plant/single_joint_model.h"
#include "sim/plant/velocity_drive.h"

namespace warmjoint {
namespace {

/// Times of the closed loop in units of 1 / bandwidth: of the largest ramp, and until an error has
/// decayed to e^-10 (1 + 10) = 5e-4 of its first size.
constexpr double kRampTimes = 4;
constexpr double kSettlingTimes = 10;

/// An explicit loop is well damped up to this bandwidth times the step.
constexpr double kLargestPhase = 0.2;

/// The bandwidth of a drive that is not told one, where its joint needs no more, rad/s.
constexpr double kCommonBandwidth = 20;

/// Of the engine, between two calls of a watch: some milliseconds.
constexpr long kStepsBetweenLooks = 4096;

/// Steps in an interval that must hold a whole number of them.
long WholeSteps(double interval, double timestep, const Scenario& scenario, const char* name) {
  const double steps = interval / timestep;
  const long whole = std::lround(steps);
  if (whole < 1 || std::abs(steps - static_cast<double>(whole)) > 1e-6 * steps) {
    Refuse({scenario.name}, "{}: {} s is not a whole number of timesteps of {} s", name, interval,
           timestep);
  }
  return whole;
}

double LargestChange(const std::vector<MotionSegment>& plan) {
  double largest = 0;
  double velocity = 0;
  for (const MotionSegment& segment : plan) {
    largest = std::max(largest, std::abs(segment.velocity - velocity));
    velocity = segment.velocity;
  }
  return largest;
}

class MujocoPlant : public Plant {
 public:
  explicit MujocoPlant(const Scenario& scenario)
      : scenario_(scenario),
        members_(StateOf(scenario.friction)),
        joint_(LoadSingleJoint(FindRobot(scenario.robot, scenario.name), scenario.joint,
                               scenario.friction, scenario.timestep, scenario.name)),
        data_(mj_makeData(joint_.model.get())),
        steps_per_sample_(
            WholeSteps(1 / scenario.sampling.rate, scenario.timestep, scenario, "sampling.rate")),
        steps_per_reading_(WholeSteps(1 / scenario.sampling.sensor_rate, scenario.timestep,
                                      scenario, "sampling.sensor_rate")) {
    const double fastest = FastestDrive();
    // a bandwidth that the step can carry
    if (!(scenario.controller.bandwidth >= 0 && scenario.controller.bandwidth <= fastest)) {
      Refuse({scenario.name},
             "controller.bandwidth is {} rad/s; at timestep {} s it must be at most {}, or 0, "
             "which chooses it",
             scenario.controller.bandwidth, scenario.timestep, fastest);
    }

    // what decides which bandwidth is enough
    const JointFriction friction(scenario.friction);
    task_ = {joint_.inertia, friction.HoldingLevel(), friction.SteepestSlope(),
             joint_.gravity_slope};
  }

  Simulation Run(std::uint64_t realization, const RunWatch& watch) override {
    const RandomKey key{scenario_.seed, realization};
    // where it goes, and at which speeds
    const double start = StartPosition(scenario_.motion, joint_.limits);
    RandomStream motion(key, Stream::motion);
    corners_ = FollowsCorners(scenario_.motion)
                   ? PlanCorners(scenario_.motion, scenario_.duration, motion)
                   : std::vector<VelocityCorner>{};
    const std::vector<MotionSegment> plan = CheckedPlan(motion, start);

    // a drive that this joint can follow, unless the scenario says which
    Simulation recording = Empty();
    recording.following = Sufficient(plan);
    bandwidth_ = recording.following.bandwidth;
    SensorLog log(scenario_, key, recording.truth.velocity.size());
    const Eigen::VectorXd position = Move(MakeReference(plan), start, log, recording, watch);
    log.WriteTo(recording);
    DisturbLog(scenario_, realization, recording, position);
    return recording;
  }

 private:
  /// The pieces at constant speed, of motions that stay within the joint's limits.
  std::vector<MotionSegment> CheckedPlan(RandomStream& motion, double start) const {
    const JointRoom room{scenario_, joint_.limits};
    if (!corners_.empty()) {
      CheckReach(room, corners_, start);
      return HoldsBetween(corners_);
    }
    const auto plan = PlanMotion(scenario_.motion, scenario_.duration, joint_.limits, motion);
    CheckReach(room, plan, start);
    return plan;
  }

  double FastestDrive() const { return kLargestPhase / scenario_.timestep; }

  /// The drive's bandwidth and the one that does.
  Following Sufficient(const std::vector<MotionSegment>& plan) const {
    Following following;
    // what the scenario says, else what does, within what the step can carry
    Advise(following, SufficientBandwidth(task_, plan));
    following.bandwidth =
        scenario_.controller.bandwidth != 0
            ? scenario_.controller.bandwidth
            : std::min(FastestDrive(), std::max(kCommonBandwidth, following.sufficient));
    return following;
  }

  /// Sets the bandwidth that does, in two digits, and the step where the scenario's is too long for it.
  void Advise(Following& following, double bandwidth) const {
    if (bandwidth == 0) return;
    // a number of two digits at or above it
    const double unit = std::pow(10, std::floor(std::log10(bandwidth)) - 1);
    following.sufficient = unit * std::ceil(bandwidth / unit);
    const double parts = std::ceil(following.sufficient / FastestDrive() * (1 - 1e-12));
    following.timestep = parts > 1 ? scenario_.timestep / parts : 0;
  }

  /// plan: of motions that are not given by corners.
  VelocityReference MakeReference(const std::vector<MotionSegment>& plan) const {
    const double settling = kSettlingTimes / bandwidth_;
    if (corners_.empty()) return {plan, Acceleration(LargestChange(plan)), settling};
    return VelocityReference::Through(corners_, Acceleration(std::abs(corners_.front().velocity)),
                                      settling);
  }

  /// Of ramps that change the velocity by up to `change`, rad/s^2 or m/s^2.
  double Acceleration(double change) const {
    const Controller& controller = scenario_.controller;
    if (controller.acceleration != 0) return controller.acceleration;
    return change * bandwidth_ / kRampTimes;
  }

  Simulation Empty() const {
    // columns are filled in while the joint moves
    const auto n =
        static_cast<Eigen::Index>(std::llround(scenario_.duration * scenario_.sampling.rate));
    Simulation recording;
    Measurements& log = recording.measurements;
    log.joint = joint_.kind;
    log.torque_unit = kTorqueUnit.For(joint_.kind);
    log.gear = scenario_.friction.gear;
    log.source = scenario_.name;

    Truth& truth = recording.truth;
    truth.friction = scenario_.friction;
    truth.initial_energy = scenario_.initial_energy;
    truth.torque_noise = scenario_.noise.torque * NoiseLeft(scenario_.sampling, n);
    truth.plant = "mujoco";
    truth.velocity = truth.force = truth.loss = truth.energy = Eigen::VectorXd::Zero(n);
    return recording;
  }

  /// Drives the joint along the reference; sensors read and samples are taken before their step. The true position of
  /// each sample, [N] rad or m.
  Eigen::VectorXd Move(VelocityReference reference, double start, SensorLog& log,
                       Simulation& recording, const RunWatch& watch) {
    Truth& truth = recording.truth;
    const mjModel* m = joint_.model.get();
    mjData* d = data_.get();
    const double h = scenario_.timestep;
    const long run_up = std::lround(std::ceil(-reference.begin() / h));
    VelocityDrive drive(joint_.inertia, bandwidth_, h);

    // cold and at rest, so far back that the first sample is at the start
    mj_resetData(m, d);
    mjtNum* const state = d->act + joint_.friction_state;
    d->qpos[0] = start - reference.run_up();
    SetEnergy(state);
    // a log that its filter delays begins with the energy of the scenario, too
    const double cutoff = scenario_.sampling.cutoff;
    const long late = cutoff > 0 ? std::lround(kSensorFilterDelay / cutoff / h) : 0;

    const Eigen::Index n = truth.velocity.size();
    Eigen::VectorXd positions(n);
    Eigen::Index sample = 0;
    SpeedWatch speed;
    double half_step_before = reference.Velocity(static_cast<double>(-run_up) * h - 0.5 * h);
    for (long step = -run_up; sample < n || !log.Full(); ++step) {
      if (step == -std::min(late, run_up)) SetEnergy(state);
      const double time = static_cast<double>(step) * h;
      const double wanted = reference.Velocity(time);
      d->ctrl[joint_.friction_control] = scenario_.disturbances.ambient_temperature.RiseAt(time);
      const bool steady = reference.acceleration() == 0;

      // about the step, since to one side of a corner the torque would lead the motion that is logged
      const double half_step_after = reference.Velocity(time + 0.5 * h);
      const double slope = (half_step_after - half_step_before) / h;
      // the drive's torque for the step
      half_step_before = half_step_after;
      const double torque = drive.Torque(wanted, slope, d->qvel[0]);
      d->qfrc_applied[0] = torque;

      // sensors and samples see the state before the step, forces during it
      const bool reads = step >= 0 && step % steps_per_reading_ == 0 && !log.Full();
      const bool stores = step >= 0 && step % steps_per_sample_ == 0 && sample < n;
      const double position = d->qpos[0], velocity = d->qvel[0];
      if (step >= 0) speed.Look(wanted, velocity, steady);
      if (stores) {
        positions[sample] = position;
        truth.velocity[sample] = velocity;
        truth.energy[sample] = EnergyIn(state);
      }
      mj_step(m, d);
      const double friction = -d->actuator_force[joint_.friction_actuator];
      if (reads) {
        log.Read({.position = position,
                  .velocity = velocity,
                  .torque = torque,
                  .rigid = torque - friction,
                  .load = d->qfrc_bias[0]});
      }
      RefusePush(time);
      if (watch && step % kStepsBetweenLooks == 0) watch(std::max(time, 0.0) / scenario_.duration);
      if (stores) {
        truth.force[sample] = friction;
        truth.loss[sample] = Loss(truth.velocity[sample], truth.force[sample]);
        ++sample;
      }
    }

    Judge(speed, recording.following);
    return positions;
  }

  /// How much of the time the joint kept to its motion.
  void Judge(const SpeedWatch& speed, Following& following) const {
    following.share = speed.share();
    // where the formula holds no answer, a faster drive is what can be tried
    const bool did = following.bandwidth >= following.sufficient;
    if (!following.Follows() && did) Advise(following, 2 * following.bandwidth);
  }

  /// E1 as the scenario begins, and no other heat.
  void SetEnergy(mjtNum* state) const {
    for (size_t i = 0; i < members_.size(); ++i) {
      if (members_[i].value == &FrictionState::energy) state[i] = scenario_.initial_energy;
      if (members_[i].value == &FrictionState::second_energy) state[i] = 0;
    }
  }

  /// E1 + E2, N.m or N.
  double EnergyIn(const mjtNum* state) const {
    FrictionState friction;
    for (size_t i = 0; i < members_.size(); ++i) friction.*members_[i].value = state[i];
    return friction.energy + friction.second_energy;
  }

  void RefusePush(double time) const {
    if (data_->plugin_state[joint_.friction_report] == 0) return;
    Refuse({scenario_.name},
           "at {:g} s friction drives the joint: its level fell below 0; move slower before, rest, "
           "or lower the thermal gain",
           time);
  }

  const Scenario scenario_;
  const std::vector<StateMember> members_;  // of the friction, as they stand in act
  SingleJointModel joint_;
  DataPtr data_;
  DriveTask task_;
  double bandwidth_ = 0;                 // of the realization at hand, rad/s
  std::vector<VelocityCorner> corners_;  // of the realization at hand; or none
  long steps_per_sample_;
  long steps_per_reading_;
};

}  // namespace

std::unique_ptr<Plant> MakeMujocoPlant(const Scenario& scenario) {
  return std::make_unique<MujocoPlant>(scenario);
}

}  // namespace warmjoint
