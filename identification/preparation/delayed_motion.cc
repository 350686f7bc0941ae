#include "identification/preparation/delayed_motion.h"

#include <algorithm>
#include <cmath>

#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// A time between two samples of a piece.
struct Between {
  Index before = 0;           // the sample before it; the next one is after it
  double share = 0;           // of the step that has passed, 0 to 1
  double step = 0;            // s
  Index first = 0, last = 0;  // samples of the piece
};

/// The cubic through both ends of a step with their slopes.
double Hermite(const Between& at, double from, double to, double slope_from, double slope_to) {
  const double s = at.share, r = 1 - s;
  return r * r * (1 + 2 * s) * from + s * s * (1 + 2 * r) * to +
         at.step * s * r * (r * slope_from - s * slope_to);
}

double Linear(const Between& at, const VectorXd& column) {
  return column[at.before] + at.share * (column[at.before + 1] - column[at.before]);
}

double WithSlopes(const Between& at, const VectorXd& column, const VectorXd& slopes) {
  const Index i = at.before;
  return Hermite(at, column[i], column[i + 1], slopes[i], slopes[i + 1]);
}

/// The cubic with slopes over both neighbours, one-sided at the ends of a piece.
double ThroughFour(const Between& at, const VectorXd& time, const VectorXd& column) {
  const auto slope = [&](Index i) {
    const Index low = std::max(at.first, i - 1), high = std::min(at.last, i + 1);
    return (column[high] - column[low]) / (time[high] - time[low]);
  };
  const Index i = at.before;
  return Hermite(at, column[i], column[i + 1], slope(i), slope(i + 1));
}

/// Pieces without gaps of each recording.
std::vector<SampleRange> Pieces(const LogSamples& m) {
  std::vector<SampleRange> pieces;
  for (const SampleRange& recording : m.Recordings()) {
    for (SampleRange piece : PiecesOf(m.time.segment(recording.first, recording.count))) {
      piece.first += recording.first;
      pieces.push_back(piece);
    }
  }
  return pieces;
}

/// Fills sample i of `late` with the motion at a time.
void Take(const LogSamples& m, const Between& at, Index i, LogSamples& late) {
  late.position[i] = WithSlopes(at, m.position, m.velocity);
  late.velocity[i] = WithSlopes(at, m.velocity, *m.acceleration);
  (*late.acceleration)[i] = ThroughFour(at, m.time, *m.acceleration);
  if (m.motor_position) (*late.motor_position)[i] = ThroughFour(at, m.time, *m.motor_position);
  if (m.mean_speed) (*late.mean_speed)[i] = Linear(at, *m.mean_speed);
  if (m.loss_velocity) (*late.loss_velocity)[i] = Linear(at, *m.loss_velocity);
}

}  // namespace

LogView Delayed(const LogView& view, double delay) {
  const LogSamples& m = view.measurements;
  LogView late = view;
  late.selection.keep.setConstant(false);
  for (const SampleRange& piece : Pieces(m)) {
    Index before = piece.first;
    for (Index i = piece.first; i < piece.end(); ++i) {
      const double t = m.time[i] - delay;
      if (piece.count < 2 || t < m.time[piece.first] || t > m.time[piece.end() - 1]) continue;
      while (before + 2 < piece.end() && m.time[before + 1] <= t) ++before;
      const double step = m.time[before + 1] - m.time[before];
      const Between at{before, (t - m.time[before]) / step, step, piece.first, piece.end() - 1};
      Take(m, at, i, late.measurements);
      // where the time is exactly at one sample, the other neighbour does not count
      const auto& keep = view.selection.keep;
      late.selection.keep[i] =
          (keep[before] || at.share == 1) && (keep[before + 1] || at.share == 0);
    }
  }
  return late;
}

LogSamples Delayed(const LogSamples& m, const std::optional<double>& delay) {
  if (!delay || !m.acceleration) return m;
  Selection all;
  all.keep.setConstant(m.size(), true);
  return Delayed(LogView{m, std::move(all)}, *delay).measurements;
}

}  // namespace warmjoint
