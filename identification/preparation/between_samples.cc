#include "identification/preparation/between_samples.h"

#include <cmath>

#include "models/friction/sign.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kContradicts = 2;  // way by positions over that by velocities, or the inverse

/// Of a velocity that is a straight line from sample i to the next: the means of |v| and of v^2 over
/// that of |v|. Where it turns, both sides of the turn count.
void TakeLine(const VectorXd& velocity, Index i, BetweenSamples& between) {
  const double from = velocity[i], to = velocity[i + 1];
  const double a = std::abs(from), b = std::abs(to);
  const bool turns = from * to < 0;
  const double speed = turns ? (a * a + b * b) / (2 * (a + b)) : (a + b) / 2;
  const double square = turns ? (a * a - a * b + b * b) / 3 : (a * a + a * b + b * b) / 3;
  between.mean_speed[i] = speed;
  between.loss_velocity[i] = speed > 0 ? Sign(from) * square / speed : from;
}

/// The way from sample `first` to sample `last` by the mean speeds, rad or m.
double WayOf(const VectorXd& time, const VectorXd& speed, Index first, Index last) {
  double way = 0;
  for (Index i = first; i < last; ++i) way += speed[i] * (time[i + 1] - time[i]);
  return way;
}

/// Scales the speeds of a stretch in one direction to the way that its positions tell.
void FollowPositions(const Measurements& m, Index first, Index last, BetweenSamples& between) {
  const double by_velocity = WayOf(m.time, between.mean_speed, first, last);
  const double by_position = std::abs(m.position[last] - m.position[first]);
  const double ratio = by_position / by_velocity;
  if (!(ratio < kContradicts && ratio > 1 / kContradicts)) return;
  between.mean_speed.segment(first, last - first) *= ratio;
  between.loss_velocity.segment(first, last - first) *= ratio;
}

/// The same for each stretch of a piece that moves clearly one way.
void FollowPositions(const Measurements& m, const SampleRange& piece, double clear,
                     BetweenSamples& between) {
  const Index end = piece.first + piece.count;
  for (Index i = piece.first; i < end; ++i) {
    if (!(std::abs(m.velocity[i]) > clear)) continue;
    // the longest stretch that keeps its direction and stays clearly away from rest
    const Index first = i;
    while (i + 1 < end && std::abs(m.velocity[i + 1]) > clear &&
           m.velocity[i + 1] * m.velocity[first] > 0) {
      ++i;
    }
    if (i > first) FollowPositions(m, first, i, between);
  }
}

/// Counts what a joint moves between a sample at rest and the next with that one.
void PassRest(const Measurements& m, const SampleRange& piece, VectorXd& speed) {
  for (Index i = piece.first; i + 2 < piece.first + piece.count; ++i) {
    if (m.velocity[i] != 0) continue;
    const double way = speed[i] * (m.time[i + 1] - m.time[i]);
    speed[i] = 0;
    if (m.velocity[i + 1] != 0) speed[i + 1] += way / (m.time[i + 2] - m.time[i + 1]);
  }
}

}  // namespace

BetweenSamples MeansBetween(const Measurements& m, const std::vector<SampleRange>& pieces,
                            double clear) {
  BetweenSamples between{m.velocity.cwiseAbs(), m.velocity};
  const bool has_positions = m.position.size() == m.size() && m.position.allFinite();
  // straight lines between the velocities, scaled to the way that the positions tell; what rest hides last
  for (const SampleRange& piece : pieces) {
    for (Index i = piece.first; i + 1 < piece.first + piece.count; ++i) {
      TakeLine(m.velocity, i, between);
    }
    if (has_positions) FollowPositions(m, piece, clear, between);
    PassRest(m, piece, between.mean_speed);
  }
  return between;
}

}  // namespace warmjoint
