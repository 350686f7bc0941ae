#include "models/friction/settled_energy.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "models/friction/joint_friction.h"

namespace warmjoint::inline models {
namespace {

/// Positions at which maps are averaged; a smooth periodic function needs far fewer.
constexpr int kPlaces = 720;

/// The positions that the maps cover: their centres, a turn of the motor, or a single place.
std::pair<double, double> Travel(const FrictionDescription& friction) {
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
  // places along the way, each in the middle of its share
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

}  // namespace

std::optional<std::vector<double>> SettledEnergy(const FrictionDescription& friction,
                                                 double velocity) {
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

}  // namespace warmjoint::inline models
