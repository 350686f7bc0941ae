#include "tools/design/motion_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace warmjoint {
namespace {

// s; why: times of a stroke's beginning and end are rounded by half a nanosecond each
constexpr double kRounding = 1e-9;

}  // namespace

// sums of strokes about 0 leave no -0
double AsInFiles(double value) { return std::round(1e9 * value) / 1e9 + 0.0; }

MotionPath::MotionPath(const MotionLimits& limits, std::optional<double> start) : limits_(limits) {
  const double middle = limits.position ? ((*limits.position)[0] + (*limits.position)[1]) / 2 : 0;
  knots_.push_back({0, AsInFiles(start.value_or(middle)), 0});
}

void MotionPath::Add(const SpeedBlock& block, double hold) {
  if (block.speed == 0) return Ramp(block.duration, 0);
  // as short as asked, and as long as their ramps need; between limits an odd number ends at another place
  const double most = std::floor(block.duration / Shortest(block.speed));
  auto strokes = static_cast<int>(
      std::clamp(std::ceil(block.duration / hold - 1e-9), 1.0, std::max(most, 1.0)));
  if (limits_.position && strokes % 2 == 0) strokes += strokes < most ? 1 : -1;
  const double whole = block.duration / strokes;
  double left = block.duration;
  int direction = walk_;
  while (left > Shortest(block.speed)) {
    if (Longest(direction, block.speed) < std::min(whole, left)) {
      // to where there is more room
      if (Longest(-direction, block.speed) > Longest(direction, block.speed)) {
        direction = -direction;
        walk_ = -walk_;
      }
    }
    const double duration = std::min(left - whole < Shortest(block.speed) ? left : whole,
                                     Longest(direction, block.speed));
    if (duration < Shortest(block.speed)) break;
    Stroke(direction * block.speed, duration);
    left -= duration;
    direction = -direction;
  }
  if (left > 1e-9) Ramp(left, 0);
  if (!limits_.position) walk_ = direction;
}

/// The stroke that ends at the limit, s.
double MotionPath::Longest(int direction, double speed) const {
  if (!limits_.position) return std::numeric_limits<double>::infinity();
  const auto [lower, upper] = *limits_.position;
  const double place = knots_.back().position;
  const double room = direction > 0 ? upper - place : place - lower;
  return std::max(room, 0.0) / speed + speed / limits_.acceleration - kRounding;
}

void MotionPath::Stroke(double velocity, double duration) {
  const double ramp = std::abs(velocity) / limits_.acceleration;
  Ramp(ramp, velocity);
  Ramp(duration - 2 * ramp, velocity);
  Ramp(ramp, 0);
}

/// A straight line of the velocity.
void MotionPath::Ramp(double duration, double velocity) {
  const MotionKnot& last = knots_.back();
  time_ += duration;
  const double time = AsInFiles(time_);
  // no faster than asked
  const double reached = std::trunc(1e9 * velocity) / 1e9;
  const double way = (time - last.time) * (last.velocity + reached) / 2;
  knots_.push_back({time, last.position + way, reached});
}

std::vector<MotionKnot> LayOut(const std::vector<SpeedBlock>& blocks, const MotionLimits& limits,
                               double hold) {
  MotionPath path(limits);
  for (const SpeedBlock& block : blocks) path.Add(block, hold);
  return path.knots();
}

MotionKnot Between(const MotionKnot& from, const MotionKnot& to, double time) {
  const double lasts = to.time - from.time, after = time - from.time;
  const double slope = lasts > 0 ? (to.velocity - from.velocity) / lasts : 0;
  return {time, from.position + after * (from.velocity + slope * after / 2),
          from.velocity + slope * after};
}

MotionCells CellsOf(const std::vector<MotionKnot>& knots, double length) {
  const double end = knots.back().time;
  const auto n =
      std::max<Eigen::Index>(static_cast<Eigen::Index>(std::ceil(end / length - 1e-9)), 2);
  MotionCells cells;
  cells.length = length;
  cells.time = length * Eigen::VectorXd::LinSpaced(n, 0, static_cast<double>(n - 1));
  cells.velocity = cells.mean_speed = cells.loss_velocity = cells.held = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd square = Eigen::VectorXd::Zero(n), longest = square;

  // each straight line's part in each cell: integrals of |v| and v^2
  for (size_t k = 1; k < knots.size(); ++k) {
    const MotionKnot &from = knots[k - 1], &to = knots[k];
    if (to.time <= from.time) continue;
    const double slope = (to.velocity - from.velocity) / (to.time - from.time);
    const bool held = from.velocity == to.velocity && to.velocity != 0;
    auto i = std::min(static_cast<Eigen::Index>(from.time / length), n - 1);
    for (double begin = from.time; begin < to.time; ++i) {
      const double stop =
          i + 1 < n ? std::min(to.time, length * static_cast<double>(i + 1)) : to.time;
      if (stop <= begin) continue;
      const double first = from.velocity + slope * (begin - from.time);
      const double last = from.velocity + slope * (stop - from.time), lasts = stop - begin;
      cells.mean_speed[i] += lasts * std::abs(first + last) / 2;
      square[i] += lasts * (first * first + first * last + last * last) / 3;
      if (held) {
        cells.held[i] += lasts;
        if (lasts > longest[i]) cells.velocity[i] = to.velocity;
        longest[i] = std::max(longest[i], lasts);
      }
      begin = stop;
    }
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    if (cells.mean_speed[i] == 0) continue;
    cells.loss_velocity[i] = std::copysign(square[i] / cells.mean_speed[i], cells.velocity[i]);
    cells.mean_speed[i] /= length;
  }
  return cells;
}

}  // namespace warmjoint
