// Joint maximum likelihood of law and warming with maps over the joint's or the motor's angle.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>

#include "identification/identifier.h"
#include "identification/maps/map_options.h"

namespace warmjoint {

/// What has a map beside law and warming.
enum class WarmMap { none, map, motor };
inline std::span<const Word<WarmMap>> WordsOf(WarmMap) {
  static constexpr std::array words{Word{"none", WarmMap::none}, Word{"map", WarmMap::map},
                                    Word{"motor", WarmMap::motor}};
  return words;
}

/// Maps beside law and warming, and how they are made.
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

/// Law, warming and the maps that the option `position` names, together. Refuses options that
/// cannot be had with maps: gravity, an estimated E(0), Huber's loss.
Fit FitWithMaps(const std::string& identifier, const IdentifierInput& input);

/// A shape of maps, and a prior.
struct ChosenMap {
  FrictionMap map;      // the first of them
  double strength = 0;  // of the prior
};

/// The maps that the option `position` names, with the kernels that suit the log beside a warming that is known;
/// nothing where none can be chosen. energy: [N] E, N.m or N, or empty: 0.
std::optional<ChosenMap> MapGivenEnergy(const IdentifierInput& input,
                                        const Eigen::VectorXd& energy);

}  // namespace warmjoint
