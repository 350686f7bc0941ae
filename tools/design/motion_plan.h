// A motion as a sequence of speeds and rests, laid out within limits.
#pragma once

#include <warmjoint/design.h>

#include <Eigen/Core>
#include <vector>

namespace warmjoint {

/// A part of a motion: back and forth at one speed, or at rest.
struct SpeedBlock {
  double duration = 0;  // s
  double speed = 0;     // rad/s or m/s; 0: a rest
};

/// Strokes of at most `hold` seconds, each from rest to rest by ramps of the limits' acceleration. Directions alternate; between
/// limits a block leads from one place to another, so that all speeds come to all places. It begins in the middle of the limits.
std::vector<MotionKnot> LayOut(const std::vector<SpeedBlock>& blocks, const MotionLimits& limits,
                               double hold);

/// A motion over even cells of time.
struct MotionCells {
  double length = 0;                // of a cell, s
  Eigen::VectorXd time{};           // [n] s, at which cells begin
  Eigen::VectorXd velocity{};       // [n] rad/s or m/s, at which samples are taken; else 0
  Eigen::VectorXd mean_speed{};     // [n] mean of |v|
  Eigen::VectorXd loss_velocity{};  // [n] mean of v^2 over that, with the sign of v
  Eigen::VectorXd held{};           // [n] s at a constant speed other than 0
};

/// knots: from time 0; length: of a cell, s
MotionCells CellsOf(const std::vector<MotionKnot>& knots, double length);

}  // namespace warmjoint
