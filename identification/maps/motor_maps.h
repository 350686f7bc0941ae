// Maps over the motor's angle beside one over the joint's.
#pragma once

#include "identification/fit.h"
#include "identification/maps/map_options.h"

namespace warmjoint {

/// How many kernels each map has.
struct MotorMapSize {
  int turn = 36;  // over the motor's turn, on a circle
  int speed = 3;  // over speed, for each direction, beside those over the turn
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
/// kernels fall on a turn, they could follow nothing that returns with the turn, only what changes while the joint
/// wanders, its heat above all: there they stand on a circle, one turn round. points: [n x 5] kept.
std::vector<std::vector<FrictionMap>> MotorMaps(const MotorMapSize& size,
                                                const MapOptions& settings, JointKind joint,
                                                const MapPoints& points);

/// Notes with the fit what was found in the motor's map: "motor ripple for v > 0: 0.052 N.m
/// at 2 a turn" and so on; and a warning where the motor's angle is not known.
/// covariance: of the map's weights, [q x q].
void DescribeMotorRipple(const FrictionMap& motor, const Eigen::MatrixXd& covariance,
                         const LogSamples& measurements, Fit& fit);

}  // namespace warmjoint
