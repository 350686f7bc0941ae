// A motion as a sequence of speeds and rests, laid out within limits.
#pragma once

#include <warmjoint/design.h>

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace warmjoint {

/// A part of a motion: back and forth at one speed, or at rest.
struct SpeedBlock {
  double duration = 0;  // s
  double speed = 0;     // rad/s or m/s; 0: a rest
};

/// To nine decimals, which is what files of motions keep of times, places and velocities.
double AsInFiles(double value);

/// A motion that grows block by block from rest to rest, by strokes of at most `hold` seconds with ramps of the limits' acceleration. Directions
/// alternate; between limits a block leads from one place to another, so that all speeds come to all places. Knots are as in files, so that what
/// is read from one keeps to the limits, too.
class MotionPath {
 public:
  /// start: where it begins; none: in the middle of the limits
  explicit MotionPath(const MotionLimits& limits, std::optional<double> start = {});

  void Add(const SpeedBlock& block, double hold);
  /// The next block begins in the other direction.
  void Turn() { walk_ = -walk_; }
  /// A stroke that reaches its speed and holds it as long as its ramps last, s.
  double Shortest(double speed) const { return 4 * speed / limits_.acceleration; }

  const std::vector<MotionKnot>& knots() const { return knots_; }

 private:
  double Longest(int direction, double speed) const;
  void Stroke(double velocity, double duration);
  void Ramp(double duration, double velocity);

  MotionLimits limits_;
  int walk_ = 1;     // direction of a block's first stroke
  double time_ = 0;  // s, of the last knot before it is rounded
  std::vector<MotionKnot> knots_;
};

/// All blocks one after the other, from the middle of the limits.
std::vector<MotionKnot> LayOut(const std::vector<SpeedBlock>& blocks, const MotionLimits& limits,
                               double hold);

/// The motion at a time between two knots.
MotionKnot Between(const MotionKnot& from, const MotionKnot& to, double time);

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
