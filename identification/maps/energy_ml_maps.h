// Maps over the motor's angle with one over the joint's, and either of them with law and warming.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>

#include "identification/fit/fit.h"
#include "identification/fit/identifier.h"
#include "identification/maps/map_options.h"

namespace warmjoint {

/// How many kernels each map has.
struct MotorMapSize {
  int turn = 36;  // over the motor's turn, on a circle
  int speed = 3;  // over speed, for each direction, in addition to those over the turn
  int arm = 20;   // over the joint's travel, for each direction; 0: no such map

  template <class A>
  void Serialize(A* a) {
    a->Field(
        "kernels", &turn,
        {.bounds = {.at_least = 3, .at_most = 128}, .meaning = "kernels over the motor's turn"});
    a->Field("velocity_kernels", &speed,
             {.bounds = {.at_least = 1, .at_most = 64},
              .meaning = "kernels over speed for each direction, beside those over the turn"});
    a->Field("arm_kernels", &arm,
             {.bounds = {.at_least = 0, .at_most = 128},
              .meaning = "kernels over the joint's position for each direction; 0: no such map"});
  }
};

/// The motor's map, first, and the joint's, for every width. Where a joint turns so far that fewer than three of its
/// kernels fall on a turn, they could follow nothing that is periodic in a turn, only what changes while the joint
/// drifts along its travel, mostly its heat. In that case they are on a circle of one turn. points: [n x 5] kept.
MapShapes MotorMaps(const MotorMapSize& size, const MapOptions& settings, JointKind joint,
                    const MapPoints& points);

/// Notes with the fit what was found in the motor's map: "motor ripple for v > 0: 0.052 N.m
/// at 2 a turn" and so on; and a warning where the motor's angle is not known.
/// covariance: of the map's weights, [q x q].
void DescribeMotorRipple(const FrictionMap& motor, const Eigen::MatrixXd& covariance,
                         const LogSamples& measurements, Fit& fit);

/// Which map there is in addition to law and warming.
enum class WarmMap { none, map, motor };
inline std::span<const Word<WarmMap>> WordsOf(WarmMap) {
  static constexpr std::array words{Word{"none", WarmMap::none}, Word{"map", WarmMap::map},
                                    Word{"motor", WarmMap::motor}};
  return words;
}

/// Maps in addition to law and warming, and how they are made.
struct WarmMapOptions : AddedMapOptions {
  WarmMap position = WarmMap::none;
  int motor_kernels = 36;

  template <class A>
  void Serialize(A* a) {
    a->Field("position", &position,
             {.meaning = "beside the law a map over position, or one over the motor's angle and "
                         "one over position"});
    AddedMapOptions::Serialize(a);
    a->Field("motor_kernels", &motor_kernels,
             {.bounds = {.at_least = 3, .at_most = 128},
              .meaning = "of the map: kernels over the motor's turn, with position motor"});
  }
};

/// Law, warming and the maps that the option `position` names, together. Refuses Huber's
/// loss, which cannot be combined with maps.
Fit FitWithMaps(const std::string& identifier, const IdentifierInput& input);

/// A shape of maps, and a prior.
struct ChosenMap {
  FrictionMap map;      // the first of them
  double strength = 0;  // of the prior
};

/// The maps that the option `position` names, with the kernels that suit the log, given the warming;
/// nothing where none can be chosen. energy: [N] E, N.m or N, or empty: 0.
std::optional<ChosenMap> MapGivenEnergy(const IdentifierInput& input,
                                        const Eigen::VectorXd& energy);

}  // namespace warmjoint
