#include "models/recording/mend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "models/foundation/robust_noise.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

constexpr Eigen::Index kFewInAll =
    100;  // one sample in so many may go: that moves no estimate by more than its noise does
constexpr std::size_t kFewestTicks = 10;  // that tell the step of a clock to a tenth

/// Where the samples of each stamp begin, and the number of samples behind the last.
std::vector<Eigen::Index> TicksOf(const Eigen::VectorXd& time) {
  std::vector<Eigen::Index> begin{0};
  for (Eigen::Index i = 1; i < time.size(); ++i) {
    if (time[i] != time[i - 1]) begin.push_back(i);
  }
  begin.push_back(time.size());
  return begin;
}

/// Whether rows of one stamp are further apart than rows of one place in neighbouring ticks: they are of several joints.
bool AreSeveral(const Eigen::VectorXd& position, const std::vector<Eigen::Index>& begin) {
  std::vector<double> within, between;
  for (std::size_t k = 0; k + 2 < begin.size() && position.size() > 0; ++k) {
    between.push_back(std::abs(position[begin[k + 1]] - position[begin[k]]));
    if (begin[k] + 1 < begin[k + 1]) {
      within.push_back(std::abs(position[begin[k] + 1] - position[begin[k]]));
    }
  }
  // in ticks the first is a part of the second; noise makes both alike
  return !within.empty() && MedianOf(within) > 2 * MedianOf(between);
}

/// Spreads the samples of each tick evenly over it.
std::string SpreadTicks(const std::vector<Eigen::Index>& begin, Eigen::VectorXd& time) {
  // how long ticks are, and the steps of their samples
  const std::size_t ticks = begin.size() - 1;
  std::vector<double> lengths, steps;
  for (std::size_t k = 0; k + 1 < ticks; ++k) {
    lengths.push_back(time[begin[k + 1]] - time[begin[k]]);
    steps.push_back(lengths.back() / static_cast<double>(begin[k + 1] - begin[k]));
  }
  const double tick = MedianOf(lengths), step = MedianOf(steps);

  Eigen::VectorXd even(time.size());
  for (std::size_t k = 0; k < ticks; ++k) {
    const auto count = static_cast<double>(begin[k + 1] - begin[k]);
    const bool is_last = k + 1 == ticks || lengths[k] > kGapSteps * tick;
    const bool is_first = k == 0 || lengths[k - 1] > kGapSteps * tick;
    // the log may begin within a tick, and end within one
    const double h = is_last || (is_first && count * step < lengths[k]) ? step : lengths[k] / count;
    const double start =
        is_first && !is_last ? time[begin[k]] + lengths[k] - count * h : time[begin[k]];
    for (Eigen::Index i = begin[k]; i < begin[k + 1]; ++i) {
      even[i] = start + h * static_cast<double>(i - begin[k]);
    }
  }
  time = std::move(even);
  return fmt::format(
      "its clock ticks every {:.4g} s, for {:.3g} samples each; they are spread evenly over it",
      tick, static_cast<double>(time.size()) / static_cast<double>(ticks));
}

/// Jumps that were undone, and how many of them lie at a gap of the log.
struct Undone {
  int jumps = 0, at_gaps = 0;
};

Undone Undo(const Eigen::VectorXd& time, const Eigen::VectorXd& velocity, double range,
            Eigen::VectorXd& position) {
  const double longest = LongestStep(time);
  Undone undone;
  double turns = 0;  // added so far, rad or m
  double before = position[0];
  for (Eigen::Index i = 1; i < position.size(); ++i) {
    const double step = position[i] - before, h = time[i] - time[i - 1];
    before = position[i];
    if (std::abs(step) > range / 2) {
      // the speeds beside a gap tell nothing of the way in it
      const bool gap = h > longest;
      const double expected =
          velocity.size() == 0 || gap ? 0 : (velocity[i] + velocity[i - 1]) / 2 * h;
      // a jump is one where the way back fits the speed better than the step itself
      const double back = std::copysign(range, step);
      if (std::abs(step - back - expected) < std::abs(step - expected)) {
        turns -= back;
        ++undone.jumps;
        undone.at_gaps += gap;
      }
    }
    position[i] += turns;
  }
  return undone;
}

}  // namespace

MendedClock MendClock(const Eigen::VectorXd& position, Eigen::VectorXd& time) {
  const Eigen::Index n = time.size();
  if (n < 2 || (time.tail(n - 1).array() > time.head(n - 1).array()).all()) return {};

  // samples that are no later than one before them
  Eigen::Index repeats = 0, late = 0;
  double latest = time[0];
  std::vector<bool> keep(static_cast<std::size_t>(n), true);
  for (Eigen::Index i = 1; i < n; ++i) {
    repeats += time[i] == time[i - 1];
    late += time[i] <= latest;
    keep[static_cast<std::size_t>(i)] = time[i] > latest;
    latest = std::max(latest, time[i]);
  }
  if (late <= n / kFewInAll) {
    return {std::move(keep),
            fmt::format("{} samples whose time is not after that of the sample before are left out",
                        late)};
  }

  // many that repeat, and none that steps back: ticks
  const std::vector<Eigen::Index> begin = TicksOf(time);
  const bool ticks = late == repeats && begin.size() > kFewestTicks && !AreSeveral(position, begin);
  return {{}, ticks ? SpreadTicks(begin, time) : ""};
}

int UndoJumps(const Eigen::VectorXd& time, const Eigen::VectorXd& velocity, double range,
              Eigen::VectorXd& position) {
  if (range > 0) return Undo(time, velocity, range, position).jumps;
  constexpr double turn = 2 * std::numbers::pi;  // rad
  constexpr double slack = 1e-3 * turn;          // sensors round their last step
  // what spans more than a turn already counts its turns
  if (position.maxCoeff() - position.minCoeff() > turn + slack) return 0;
  Eigen::VectorXd unwrapped = position;
  const Undone undone = Undo(time, velocity, turn, unwrapped);

  // jumps at gaps alone may be motion that was not logged
  if (undone.jumps == undone.at_gaps) return 0;
  position = std::move(unwrapped);
  return undone.jumps;
}

}  // namespace warmjoint
