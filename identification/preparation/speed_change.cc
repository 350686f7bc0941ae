#include "identification/preparation/speed_change.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kAlike = 0.01;    // of the greater speed
constexpr double kWorthARamp = 4;  // squared deviations
constexpr double kCertain = 4;     // standard errors of the crossing
constexpr double kLineErrors = 3;  // standard errors of a line
constexpr int kGrid = 48;          // why: with 72 an answer changes by 0.05 half widths at most
constexpr int kGolden = 40;

// why: with the margin alone 1 to 4 samples a log of the wrong sign stay
constexpr double kOfTheChange = 0.1;  // of its duration, in addition to the margin

/// The minimum of squares(D) between two durations, one of which may be 0.
template <typename Function>
double GoldenSection(double low, double high, const Function& squares) {
  constexpr double share = 2 - std::numbers::phi;
  double left = low + share * (high - low), right = high - share * (high - low);
  double at_left = squares(left), at_right = squares(right);
  // the interval loses the end next to the larger of two values within it
  for (int i = 0; i < kGolden; ++i) {
    if (at_left < at_right) {
      high = right, right = left, at_right = at_left;
      left = low + share * (high - low), at_left = squares(left);
    } else {
      low = left, left = right, at_left = at_right;
      right = high - share * (high - low), at_right = squares(right);
    }
  }
  return at_left < at_right ? left : right;
}

/// Positions around a change of speed, nearest to where the lines cross first. A ramp of duration D leaves the line of its
/// side by (v1 - v0) / (2 D) (D / 2 - |t|)^2 at the time t from there, |t| < D / 2.
class AroundCrossing {
 public:
  AroundCrossing(const VectorXd& time, const VectorXd& position, const SpeedChange& jump,
                 Index first, Index last)
      : change_of_speed_(jump.behind.slope - jump.before.slope) {
    // outwards from the crossing, the nearer of the next on both sides first
    Index behind = first;
    while (behind <= last && time[behind] < jump.time) ++behind;
    Index before = behind - 1;
    while (before >= first || behind <= last) {
      const bool takes_before = behind > last || (before >= first && jump.time - time[before] <=
                                                                         time[behind] - jump.time);
      const Index i = takes_before ? before-- : behind++;
      const StraightLine& line = takes_before ? jump.before : jump.behind;
      away_.push_back(std::abs(time[i] - jump.time));
      off_.push_back(position[i] - line.At(time[i]));
    }
    // squares of the positions that no ramp reaches
    beyond_.assign(off_.size() + 1, 0);
    for (size_t i = off_.size(); i > 0; --i) {
      beyond_[i - 1] = beyond_[i] + off_[i - 1] * off_[i - 1];
    }
  }

  /// Sum of squares of the positions less a change of that duration.
  double Squares(double duration) const {
    const double half = duration / 2, bend = change_of_speed_ / (2 * duration);
    double sum = 0;
    size_t i = 0;
    for (; i < away_.size() && away_[i] < half; ++i) {
      const double inside = half - away_[i], off = off_[i] - bend * inside * inside;
      sum += off * off;
    }
    return sum + beyond_[i];
  }

 private:
  double change_of_speed_;      // rad/s or m/s
  std::vector<double> away_;    // s, ascending
  std::vector<double> off_;     // the line of its side, rad or m
  std::vector<double> beyond_;  // squares of `off_` from each on
};

/// The duration of least squares, 0 where a jump explains the positions as well.
double FindDuration(const VectorXd& time, const VectorXd& position, const SpeedChange& jump,
                    Index first, Index last, double deviation) {
  const AroundCrossing around(time, position, jump, first, last);
  const auto squares = [&](double duration) { return around.Squares(duration); };
  // the best duration of an even grid, then the minimum around it
  const double longest = 2 * std::min(jump.time - time[first], time[last] - jump.time);
  const double at_jump = squares(0);
  double best = 0, least = at_jump;
  for (int i = 1; i <= kGrid; ++i) {
    const double value = squares(longest * i / kGrid);
    if (value < least) least = value, best = longest * i / kGrid;
  }
  const double step = longest / kGrid;
  const double refined =
      GoldenSection(std::max(best - step, 0.0), std::min(best + step, longest), squares);
  // a ramp must explain more than noise does
  const double gained = at_jump - squares(refined);
  return gained > kWorthARamp * deviation * deviation ? refined : 0;
}

/// Whether each position is that of the change.
bool Follows(const VectorXd& time, const VectorXd& position, const SpeedChange& change, Index first,
             Index last, const PositionNoise& noise) {
  for (Index i = first; i <= last; ++i) {
    const double t = time[i];
    const double of_line = std::max(t < change.end() ? change.before.ErrorAt(t) : 0,
                                    t > change.begin() ? change.behind.ErrorAt(t) : 0);
    if (std::abs(position[i] - change.At(t)) > noise.reach + kLineErrors * of_line) return false;
  }
  return true;
}

}  // namespace

double StraightLine::ErrorAt(double t) const {
  const double away = t - time;
  return deviation * std::sqrt(1 / samples + (spread > 0 ? away * away / spread : 0));
}

std::optional<StraightLine> FitStraightLine(const VectorXd& time, const VectorXd& values,
                                            Index first, Index last, const SampleMask& use) {
  // middle of the samples, through which the line goes
  StraightLine line;
  for (Index i = first; i <= last; ++i) {
    if (!use[i]) continue;
    line.time += time[i];
    line.value += values[i];
    ++line.samples;
  }
  if (line.samples < 2) return std::nullopt;
  line.time /= line.samples;
  line.value /= line.samples;

  // slope by least squares
  double product = 0, squares = 0;
  for (Index i = first; i <= last; ++i) {
    if (!use[i]) continue;
    const double t = time[i] - line.time;
    line.spread += t * t;
    product += t * (values[i] - line.value);
  }
  line.slope = product / line.spread;
  // deviation of the samples, two degrees of freedom taken by the line
  for (Index i = first; i <= last; ++i) {
    if (use[i]) squares += std::pow(values[i] - line.At(time[i]), 2);
  }
  line.deviation = std::sqrt(squares / std::max(line.samples - 2, 1.0));
  return line;
}

double SpeedChange::At(double t) const {
  if (t <= begin()) return before.At(t);
  if (t >= end()) return behind.At(t);
  const double since = t - begin();
  return before.At(t) + (behind.slope - before.slope) / (2 * duration) * since * since;
}

std::optional<SpeedChange> FindSpeedChange(const VectorXd& time, const VectorXd& position,
                                           const StraightLine& before, const StraightLine& behind,
                                           Index first, Index last, const PositionNoise& noise) {
  // lines of almost one speed do not show where they cross
  const double change_of_speed = std::abs(behind.slope - before.slope);
  const double fastest = std::max(std::abs(before.slope), std::abs(behind.slope));
  if (!(change_of_speed > kAlike * fastest)) return std::nullopt;

  // where the lines cross, counted from the middle between them so that no digits are lost
  SpeedChange change{before, behind};
  const double middle = (time[first] + time[last]) / 2;
  change.time = middle + (before.At(middle) - behind.At(middle)) / (behind.slope - before.slope);
  if (!(change.time >= time[first] && change.time <= time[last])) return std::nullopt;
  change.duration = FindDuration(time, position, change, first, last, noise.deviation);
  if (!Follows(time, position, change, first, last, noise)) return std::nullopt;

  // the largest distance from the change at which a sample may belong to it
  const double error =
      std::hypot(before.ErrorAt(change.time), behind.ErrorAt(change.time)) / change_of_speed;
  change.margin = std::max({std::sqrt(2 * noise.reach * change.duration / change_of_speed) / 2,
                            noise.reach / change_of_speed, kCertain * error}) +
                  kOfTheChange * change.duration;
  return change;
}

}  // namespace warmjoint
