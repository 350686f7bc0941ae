#include <algorithm>
#include <cmath>
#include <iterator>

#include "identification/preparation/select.h"
#include "identification/preparation/velocity_scale.h"
#include "models/foundation/robust_noise.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

using Eigen::Index;

// the largest of noise, share and resolution counts
constexpr double kSettled = 0.005;    // of the speed: to which a start must settle, and a drift
constexpr double kDriftOfBand = 0.6;  // a hold that drifts by more leaves its band
constexpr double kSlowly = 0.01;      // of the steepest acceleration: a hold that drifts, no ramp

// standard deviation of a robust deviation of n independent normal samples, times sqrt(n), over its value: its variance is
// 1 / 0.37 of that of the standard deviation, 1 / (2 n)
constexpr double kRobustSpread = 1.16;

// a jump from one speed to the next
constexpr double kJumpDeviations = 8;   // of the noise
constexpr double kJumpOverBeside = 10;  // times the changes before and after it
constexpr double kClearJump = 0.5;      // of the step between two speeds

// lengths of runs, in samples or as one over the other
constexpr Index kShortest = 3;      // samples of a hold
constexpr Index kHandful = 20;      // samples, of which fewer show no ripple
constexpr Index kCalm = 50;         // one in as many of a run must follow each other settled
constexpr Index kMuchShorter = 3;   // times: neighbours that are part of an acceleration
constexpr Index kTurningPoint = 5;  // times shorter than the ramps next to it
constexpr Index kReversal = 10;     // times shorter than the holds next to it
constexpr Index kOutliers = 10;     // times shorter than the runs that they divide
constexpr Index kOfTheRamp = 10;    // one in as many of a ramp's samples is cut at each end
constexpr Index kMostCut = 4;       // but no more than one in as many of the hold

/// Whether v jumps between samples i - 1 and i while it is steady before and after.
bool Jumps(const Eigen::VectorXd& v, Index i, const VelocityScale& scale) {
  const double jump = std::abs(v[i] - v[i - 1]);
  const double before = i >= 2 ? std::abs(v[i - 1] - v[i - 2]) : 0;
  const double after = i + 1 < v.size() ? std::abs(v[i + 1] - v[i]) : 0;
  const double smallest =
      std::max({kJumpDeviations * scale.noise, VelocityScale::kLevels * scale.resolution,
                1e-9 * std::abs(v[i])});
  return jump > smallest && jump > kJumpOverBeside * std::max(before, after);
}

std::vector<Segment> Grow(const Eigen::VectorXd& v, const SampleRange& piece,
                          const VelocityScale& scale) {
  std::vector<Segment> runs;
  Index begin = piece.first;
  double sum = v[begin];
  // a run goes on while the speed stays within a band around its mean
  for (Index i = begin + 1; i <= piece.end(); ++i) {
    const auto length = static_cast<double>(i - begin);
    const double mean = sum / length;

    // the mean of a short run is itself uncertain
    const bool goes_on = i < piece.end() &&
                         std::abs(v[i] - mean) <= scale.Band(mean) * std::sqrt(1 + 1 / length) &&
                         !Jumps(v, i, scale);
    // the run grows, or ends in front of this sample
    if (goes_on) {
      sum += v[i];
    } else {
      runs.push_back({begin, i, mean});
      begin = i;
      sum = i < piece.end() ? v[i] : 0;
    }
  }
  return runs;
}

/// Whether a run is no more than a few outliers between two runs at one speed.
bool Interrupts(const Segment& run, const Segment& before, const Segment& after,
                const VelocityScale& scale) {
  const Index around = std::min(before.end - before.begin, after.end - after.begin);
  const bool is_brief = kOutliers * (run.end - run.begin) <= around;
  const bool is_one_speed =
      std::abs(before.velocity - after.velocity) <= scale.Band(before.velocity) / 2;
  return is_brief && is_one_speed;
}

/// Cuts a piece without gaps into runs that stay within scale.Band of their mean: a run ends at a
/// sample that leaves the band, or at a jump between two steady speeds. Runs that a few outliers
/// alone divide are joined. Together they hold every sample, so ramps come as many short runs. One
/// pass.
std::vector<Segment> CutIntoRuns(const Eigen::VectorXd& v, const SampleRange& piece,
                                 const VelocityScale& scale) {
  const std::vector<Segment> runs = Grow(v, piece, scale);
  std::vector<Segment> joined;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    // a few outliers between two runs of one speed do not end it
    if (!joined.empty() && i + 1 < runs.size() &&
        Interrupts(runs[i], joined.back(), runs[i + 1], scale)) {
      joined.back().end = runs[++i].end;
    } else {
      joined.push_back(runs[i]);
    }
  }
  return joined;
}

Index Length(const Segment& segment) { return segment.end - segment.begin; }

/// Cuts the ends of a run inwards, to the first few samples in a row that are inside. Samples outside
/// between them are kept, since they are a ripple by the load. Empty where the run never settles.
template <typename IsInside>
void CutInwards(Segment& run, const IsInside& is_inside) {
  const Index calm = std::max(kShortest, 1 + Length(run) / kCalm);  // samples in a row
  Index begin = run.begin, end = run.end;
  for (Index inside = 0; begin + inside < run.end && inside < calm;) {
    const bool is_calm = is_inside(begin + inside);
    begin += is_calm ? 0 : inside + 1;
    inside = is_calm ? inside + 1 : 0;
  }
  for (Index inside = 0; end - inside > begin && inside < calm;) {
    const bool is_calm = is_inside(end - 1 - inside);
    end -= is_calm ? 0 : inside + 1;
    inside = is_calm ? inside + 1 : 0;
  }
  run = {begin, end, run.velocity};
}

/// The samples of a run that are inside, around its middle.
template <typename IsInside>
void CutOutwards(Segment& run, const IsInside& is_inside) {
  const Index middle = (run.begin + run.end) / 2;
  Index begin = middle, end = middle;
  while (begin > run.begin && is_inside(begin - 1)) --begin;
  while (end < run.end && is_inside(end)) ++end;
  run = {begin, end, run.velocity};
}

/// Robust deviation, as that of a normal distribution: median distance from a level over 0.6745. strays: distances
double SpreadOfStrays(Eigen::VectorXd strays) { return MedianInPlace(strays) / 0.6745; }

/// Sets the level of a run to its median and cuts its ends where the speed still settles: to within
/// the noise and the ripple of the load, both of which spread the samples. A handful of samples shows no ripple.
void Settle(Segment& run, const Eigen::VectorXd& v, const VelocityScale& scale) {
  Eigen::VectorXd values = v.segment(run.begin, Length(run));
  run.velocity = MedianInPlace(values);
  const double spread = SpreadOfStrays((values.array() - run.velocity).abs());
  // the largest deviation of a settled speed: by its ripple, noise, level or resolution
  const double allowed =
      std::max({VelocityScale::kFar * spread, VelocityScale::kNear * scale.noise,
                kSettled * std::abs(run.velocity), VelocityScale::kLevels * scale.resolution});
  const auto is_inside = [&](Index i) { return std::abs(v[i] - run.velocity) <= allowed; };
  if (Length(run) < kHandful) {
    CutOutwards(run, is_inside);
  } else {
    CutInwards(run, is_inside);
  }
}

/// How far the samples of a hold may lie from its level: the band, which covers the noise, or, where they spread by
/// more than noise does by chance, a ripple by the load. A handful of samples shows no ripple. strays: [n] distances
double LimitOfStrays(const Eigen::ArrayXd& strays, double level, const VelocityScale& scale) {
  const double band = scale.Band(level);
  const double rippling = VelocityScale::kFar * SpreadOfStrays(strays);
  const double independent = std::max(1.0, static_cast<double>(strays.size()) / scale.memory);
  const double by_chance = 1 + VelocityScale::kFar * kRobustSpread / std::sqrt(independent);
  return strays.size() >= kHandful && rippling > by_chance * band ? rippling : band;
}

/// Quarters of a run; halves of a short one.
Index Parts(const Segment& run) { return Length(run) < 8 ? 2 : 4; }

/// Largest difference between the mean speeds of the run's parts.
double Drift(const Segment& run, const Eigen::VectorXd& v) {
  // parts of one length, of which the last ends with the run
  const Index part = Length(run) / Parts(run);
  double lowest = v.segment(run.begin, part).mean(), highest = lowest;
  for (Index k = 1; k < Parts(run); ++k) {
    const Index begin = k + 1 < Parts(run) ? run.begin + k * part : run.end - part;
    const double mean = v.segment(begin, part).mean();
    lowest = std::min(lowest, mean);
    highest = std::max(highest, mean);
  }
  return highest - lowest;
}

/// Whether a drift is small relative to the steepest acceleration of the log.
bool IsSlow(double drift, const Segment& run, const VelocityScale& scale) {
  return drift <= kSlowly * scale.steepest * static_cast<double>(Length(run)) * scale.step;
}

/// Whether the speed drifts, not slowly, by more than the noise of those means and the allowed deviation of a start from the level.
bool Drifts(const Segment& run, const Eigen::VectorXd& v, const VelocityScale& scale) {
  const double drift = Drift(run, v);
  const auto independent = static_cast<double>(Length(run) / Parts(run)) / scale.memory;
  const double noise = VelocityScale::kFar * scale.noise / std::sqrt(std::max(independent, 1.0));
  const double explained =
      kSettled * std::abs(run.velocity) + std::max(noise, 0.5 * scale.resolution);
  return drift > std::min(explained, kDriftOfBand * scale.Band(run.velocity)) &&
         !IsSlow(drift, run, scale);
}

/// Whether a run differs from a piece of an acceleration: the speed drifts slowly, or at each end
/// it jumps (by much of the step in level), the recording ends, or a much
/// shorter run follows.
bool StandsOut(const std::vector<Segment>& runs, std::size_t i, const Eigen::VectorXd& v,
               const VelocityScale& scale) {
  const Segment& run = runs[i];
  const auto is_clear = [&](const Segment& other, Index boundary) {
    const double jump = std::abs(v[boundary] - v[boundary - 1]);
    return kMuchShorter * Length(other) <= Length(run) ||
           jump >= kClearJump * std::abs(other.velocity - run.velocity);
  };
  const bool is_clear_in_front = i == 0 || is_clear(runs[i - 1], run.begin);
  const bool is_clear_behind = i + 1 == runs.size() || is_clear(runs[i + 1], run.end);
  return (is_clear_in_front && is_clear_behind) || IsSlow(Drift(run, v), run, scale);
}

/// Samples between run i and its neighbours (or the ends of the recording).
std::pair<Index, Index> Gaps(const std::vector<Segment>& runs, std::size_t i, Index samples) {
  const Index before = i == 0 ? 0 : runs[i - 1].end;
  const Index after = i + 1 == runs.size() ? samples : runs[i + 1].begin;
  return {runs[i].begin - before, after - runs[i].end};
}

/// Drops runs much shorter than the accelerations next to them: turning points of the speed.
std::vector<Segment> WithoutTurningPoints(const std::vector<Segment>& runs, Index samples) {
  std::vector<Segment> lasting;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto [front, back] = Gaps(runs, i, samples);
    if (kTurningPoint * Length(runs[i]) >= front + back) lasting.push_back(runs[i]);
  }
  return lasting;
}

/// Whether a run leads from one direction of motion to the other: slower than both
/// neighbours, which move in opposite directions, and much shorter than each. A joint that turns under a slow
/// drive creeps there at a constant speed while its friction still builds up.
bool TurnsRound(const Segment& before, const Segment& run, const Segment& after) {
  const double slower = std::min(std::abs(before.velocity), std::abs(after.velocity));
  return before.velocity * after.velocity < 0 && std::abs(run.velocity) < slower &&
         kReversal * Length(run) <= std::min(Length(before), Length(after));
}

/// Whether a run is a start or an end of a much longer hold that rings: no further from it than the run lasts, with a
/// band that touches that of the hold. The torque is far from settled where the speed is within some per cent.
bool Rings(const Segment& run, const Segment& hold, const VelocityScale& scale) {
  const Index apart = std::max(hold.begin - run.end, run.begin - hold.end);
  const double touching = scale.Band(run.velocity) + scale.Band(hold.velocity);
  return kReversal * Length(run) <= Length(hold) && apart <= Length(run) &&
         std::abs(run.velocity - hold.velocity) <= touching;
}

/// Drops runs that only lead from one hold to the next.
std::vector<Segment> WithoutTransitions(const std::vector<Segment>& runs,
                                        const VelocityScale& scale) {
  std::vector<Segment> lasting;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Segment* before = i > 0 ? &runs[i - 1] : nullptr;
    const Segment* after = i + 1 < runs.size() ? &runs[i + 1] : nullptr;
    const bool turns = before && after && TurnsRound(*before, runs[i], *after);
    const bool rings =
        (before && Rings(runs[i], *before, scale)) || (after && Rings(runs[i], *after, scale));
    if (!turns && !rings) lasting.push_back(runs[i]);
  }
  return lasting;
}

/// The run less a share of the acceleration at each end, whose start and end hide in the noise.
/// Neighbours without a sample between them lose nothing.
Segment KeptAway(Segment run, std::pair<Index, Index> gaps) {
  const Index most = Length(run) / kMostCut;
  const Index front = std::min(gaps.first / kOfTheRamp, most);
  const Index back = std::min(gaps.second / kOfTheRamp, most);
  if (Length(run) - front - back < kShortest) return run;
  return {run.begin + front, run.end - back, run.velocity};
}

/// The runs at one speed, rests among them, each cut to where the speed has settled.
std::vector<Segment> SteadyRuns(const Measurements& measurements, const VelocityScale& scale) {
  const Eigen::VectorXd& v = measurements.velocity;
  std::vector<Segment> runs, steady;
  for (const SampleRange& piece : PiecesOf(measurements.time)) {
    std::ranges::move(CutIntoRuns(v, piece, scale), std::back_inserter(runs));
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    // pieces of accelerations are left out
    if (Length(runs[i]) < kShortest || !StandsOut(runs, i, v, scale)) continue;
    Segment run = runs[i];
    Settle(run, v, scale);
    if (Length(run) < kShortest || Drifts(run, v, scale)) continue;
    steady.push_back(run);
  }
  return WithoutTransitions(WithoutTurningPoints(steady, v.size()), scale);
}

}  // namespace

void TakeOptions(const PrepareSettings& holds, const Eigen::VectorXd& time, Selection& selection) {
  constexpr double rounding = 1e-9;  // s, of time stamps
  std::vector<Segment> left;
  for (const Segment& segment : selection.segments) {
    // a segment lasts until the sample after its last
    const Index behind = std::min(segment.end, time.size() - 1);
    const double lasts = time[behind] - time[segment.begin];
    Segment kept = segment;
    // a short segment is left out whole, others lose `trim` seconds at each end
    if (lasts < holds.shortest_hold - rounding) {
      kept.end = kept.begin;
    } else if (holds.trim > 0) {
      while (kept.begin < kept.end &&
             time[kept.begin] < time[segment.begin] + holds.trim - rounding) {
        ++kept.begin;
      }
      while (kept.end > kept.begin &&
             time[kept.end - 1] > time[segment.end - 1] - holds.trim + rounding) {
        --kept.end;
      }
    }
    // samples that were cut off are not fitted
    selection.keep.segment(segment.begin, kept.begin - segment.begin).setConstant(false);
    selection.keep.segment(kept.end, segment.end - kept.end).setConstant(false);
    if (kept.begin < kept.end) left.push_back(kept);
  }
  selection.segments = left;
}

ConstantSpeed FindConstantSpeed(const Measurements& measurements) {
  const Eigen::VectorXd& v = measurements.velocity;
  const VelocityScale scale = MeasureVelocity(measurements);
  const std::vector<Segment> steady = SteadyRuns(measurements, scale);

  ConstantSpeed found;
  Selection& selection = found.selection;
  selection.keep.setConstant(v.size(), false);
  // rests are no segments; segments keep a distance from their neighbours
  for (std::size_t i = 0; i < steady.size(); ++i) {
    if (std::abs(steady[i].velocity) <= scale.Rest()) {
      found.rests.push_back(steady[i]);
      continue;
    }
    Segment segment = KeptAway(steady[i], Gaps(steady, i, v.size()));

    // outliers within a segment are not kept, the peaks of a ripple of the load are
    const auto values = v.segment(segment.begin, Length(segment)).array();
    const Eigen::ArrayXd strays = (values - segment.velocity).abs();
    selection.keep.segment(segment.begin, Length(segment)) =
        strays <= LimitOfStrays(strays, segment.velocity, scale);
    segment.velocity = values.mean();
    selection.segments.push_back(segment);
  }
  return found;
}

Selection SelectConstantSpeed(const Measurements& measurements) {
  return FindConstantSpeed(measurements).selection;
}

Selection SelectMoving(const Measurements& measurements) {
  return {measurements.velocity.array() != 0, {}};
}

}  // namespace warmjoint
