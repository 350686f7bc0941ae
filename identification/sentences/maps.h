// Of maps, and of the law and the warming that are fitted with them.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/friction.h>
#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "identification/fit/fit.h"

namespace warmjoint {

/// A run of kernels without data along the first axis of a map, in its unit.
struct HoleRange {
  MapQuantity quantity = MapQuantity::position;
  double lower = 0, upper = 0;
};
/// Where the line of that run lies along another axis.
struct LinePlace {
  MapQuantity over = MapQuantity::velocity;
  double centre = 0;
  bool is_direction = false;  // the one line of its direction
};
/// "position 0.015 to 0.027 m backwards". line: along the second axis and those after it
std::string NameOfHole(const HoleRange& hole, const std::vector<LinePlace>& line, JointKind joint);
/// The words for holes that are not named one by one.
std::string NameOfSmallerHoles(std::size_t count);

/// Maps that were fitted with a law.
struct FittedMaps {
  std::string_view law;
  const std::vector<FrictionMap>& maps;
  Eigen::Index samples = 0;
  double strength = 0;   // of the prior on their weights
  double effective = 0;  // parameters
};
/// What was done: a clause.
std::string SummaryOfMaps(const FittedMaps& fitted);

// why there are no maps
inline constexpr const char* kMapOverUnknownLoad =
    "the recording has no column load; log the load that the joint transmits, or use energy-map";
inline constexpr const char* kMapBesideGravity =
    "position=map cannot be had together with gravity; leave one of them out (basis=position takes "
    "gravity up into the map)";
inline constexpr const char* kUnsolvableMaps =
    "the normal equations cannot be solved: torque or velocity are too large or too small to "
    "square; check their units";
/// The sentence about a map over a quantity that only positions show.
std::string ExplainMapWithoutPositions(MapQuantity quantity);
/// The sentence about two options that exclude each other, by their words.
std::string ExplainMapBesideLoss(std::string_view position, std::string_view loss);

inline constexpr const char* kMapHoldsGravity =
    "the map holds what acts alike in both directions, as gravity does, which is no friction; add "
    "--gravity sincos";
inline constexpr const char* kMotorTurnsWithJoint =
    "the motor is taken to turn with the joint: give --gear, or log motor_position";

/// The sentence about a parameter of the law that was set to its lower bound.
std::string ExplainHeldBesideMaps(const Unknown& parameter);
/// The sentence about parameters, by their names, that maps can imitate.
std::string ExplainImitated(const std::vector<std::string>& names);
/// The sentence about friction below 0 at a speed. fit: with gravity or without
std::string ExplainDrivingFriction(const FrictionAtSpeed& at, const LogSamples& measurements,
                                   const Fit& fit);
/// The sentence about places without data (NameHoles).
std::string ExplainHoles(const std::vector<std::string>& holes);
/// The sentence about a motor's ripple. harmonics: how often a turn, and amplitude in `unit`
std::string ExplainMotorRipple(bool forwards, const std::vector<std::pair<int, double>>& harmonics,
                               const std::string& unit);

inline constexpr const char* kFewerKernels = "use fewer kernels, or another law";  // a remedy
inline constexpr const char* kWithTheMaps = " with the maps";                      // of a warming
inline constexpr const char* kMapsDoNotRest =
    "maps and warming together do not come to rest; does the torque column hold friction?";
/// The sentence about maps without warming. why: a clause
std::string ExplainWithoutWarming(std::string_view why);
/// The sentence about warming that was fitted together with maps; the next is about maps over the energy that it gives.
std::string ExplainWarmingBesideMaps(int iterations);
std::string ExplainMapsOverEnergy(int rounds);

}  // namespace warmjoint
