#include <warmjoint/friction_model.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "models/foundation/bad_input.h"
#include "models/friction/along_motion.h"
#include "models/friction/friction_json.h"

namespace warmjoint {
namespace {

/// Positions at which maps are averaged; a smooth periodic function needs far fewer.
constexpr int kPlaces = 720;

/// The positions that the maps cover: their centres, a turn of the motor, or a single place.
std::pair<double, double> Travel(const Friction& friction) {
  // all axes over the position together
  double first = 0, last = 0;
  bool by_position = false, by_motor = false;
  for (const FrictionMap& map : friction.maps) {
    for (const MapAxis& axis : map.axes) {
      by_motor = by_motor || axis.quantity == MapQuantity::motor_position;
      if (axis.quantity != MapQuantity::position) continue;
      const auto& centres = axis.kernels.centres;
      const double begin = centres.front();
      const double end = axis.kernels.period ? begin + *axis.kernels.period : centres.back();
      first = by_position ? std::min(first, begin) : begin;
      last = by_position ? std::max(last, end) : end;
      by_position = true;
    }
  }

  // a motor's turn is the gear's part of a joint's turn
  if (by_position || !by_motor) return {first, last};
  return {0, 2 * std::numbers::pi / std::abs(friction.gear)};
}

/// Mean power lost at one velocity and energy, W; 0 where friction would push.
double MeanLoss(const JointFriction& joint, double v, double energy,
                const std::pair<double, double>& travel) {
  const int places = travel.first == travel.second ? 1 : kPlaces;
  double sum = 0;
  // places along the path, each in the middle of its share
  for (int i = 0; i < places; ++i) {
    const double share = (i + 0.5) / places;
    const double position = travel.first + share * (travel.second - travel.first);
    sum += std::max(0.0, joint.SlidingForce(v, {position, energy, 0}) * v);
  }
  return sum / places;
}

/// Where `excess` changes its sign between `below` (negative) and `above`.
template <typename F>
double Bisect(double below, double above, const F& excess) {
  while (true) {
    const double middle = below + (above - below) / 2;
    if (middle == below || middle == above) return middle;
    (excess(middle) < 0 ? below : above) = middle;
  }
}

/// Refuses a column that has not a finite number for each of n samples; an empty one is 0 throughout.
void CheckColumn(const Eigen::VectorXd& column, const char* name, Eigen::Index n) {
  if (column.size() != 0 && column.size() != n) {
    Refuse({"motion"}, "{} has {} values and time has {}; give one for each sample or none", name,
           column.size(), n);
  }
  if (!column.allFinite()) Refuse({"motion"}, "{} holds what is no number", name);
}

void CheckMotion(const JointTrajectory& motion) {
  const Eigen::Index n = motion.time.size();
  // time and velocity are the least that a motion needs
  if (n == 0 || motion.velocity.size() == 0) {
    Refuse({"motion"}, "has {} times and {} velocities; give one of both for each sample", n,
           motion.velocity.size());
  }
  const std::pair<const char*, const Eigen::VectorXd*> columns[]{
      {"time", &motion.time},
      {"velocity", &motion.velocity},
      {"position", &motion.position},
      {"motor_position", &motion.motor_position},
      {"load", &motion.load},
      {"ambient_rise", &motion.ambient_rise},
      {"level", &motion.level},
      {"mean_speed", &motion.mean_speed},
      {"loss_velocity", &motion.loss_velocity},
      {"torque", &motion.torque}};
  for (const auto& [name, column] : columns) CheckColumn(*column, name, n);

  // time increases, and recordings that were joined begin in order
  for (Eigen::Index i = 1; i < n; ++i) {
    if (motion.time[i] > motion.time[i - 1]) continue;
    Refuse({"motion"}, "time of sample {} is {} s, after {} s; it must increase", i + 1,
           motion.time[i], motion.time[i - 1]);
  }
  Eigen::Index last = 0;
  for (const Eigen::Index start : motion.starts) {
    if (start <= last || start >= n) {
      Refuse({"motion"}, "starts has {} after {}; they must ascend between 0 and {}", start, last,
             n);
    }
    last = start;
  }
}

}  // namespace

std::optional<std::vector<double>> SettledEnergy(const Friction& friction, double velocity) {
  CheckFriction(friction);
  if (!std::isfinite(velocity)) Refuse({"velocity"}, "is {}, no number", velocity);
  if (!friction.thermal) return std::vector<double>{};
  const double first = friction.thermal->gain;
  const double second = friction.second_thermal ? friction.second_thermal->gain : 0;
  const double gain = first + second;

  // E - k W(E) grows with E for k < 0, and for k > 0 as long as the losses do not run away
  const JointFriction joint(friction);
  const auto travel = Travel(friction);
  const auto excess = [&](double energy) {
    return energy - gain * MeanLoss(joint, velocity, energy, travel);
  };
  double below = std::min(0.0, gain * MeanLoss(joint, velocity, 0, travel)), above = 0;
  if (gain > 0) {
    above = std::max(1.0, -excess(0));
    constexpr double kLargest = 1e12;  // N.m or N
    while (excess(above) < 0 && above < kLargest) above *= 2;
    if (above >= kLargest) return std::nullopt;
  }
  const double energy = gain == 0 ? 0 : Bisect(below, above, excess);

  // both stages settle on the same loss
  const double loss = MeanLoss(joint, velocity, energy, travel);
  std::vector<double> stages{first * loss};
  if (friction.second_thermal) stages.push_back(second * loss);
  return stages;
}

struct FrictionModel::State {
  JointFriction joint;
  AlongMotion along;
};

FrictionModel::FrictionModel(const Friction& friction, double timestep) {
  if (!(std::isfinite(timestep) && timestep > 0)) {
    Refuse({"timestep"}, "is {}; it must be above 0, s", timestep);
  }
  const Friction whole = Completed(friction, {"friction"});
  State state{JointFriction(whole), AlongMotion(whole)};
  state.joint.SetTimestep(timestep);
  state_ = std::make_shared<const State>(std::move(state));
}

double FrictionModel::Force(double velocity, const JointPlace& place) const {
  return velocity == 0 ? 0 : state_->joint.SlidingForce(velocity, place);
}

double FrictionModel::HoldingLevel() const { return state_->joint.HoldingLevel(); }

FrictionStep FrictionModel::Step(const FrictionState& state, const JointMotion& motion) const {
  return state_->joint.Step(state, motion);
}

Prediction FrictionModel::Along(const JointTrajectory& motion, const ThermalStart& start) const {
  CheckMotion(motion);
  return state_->along.Predict(motion, start);
}

}  // namespace warmjoint
