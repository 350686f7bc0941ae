#include "identification/score/compensation_score.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "models/foundation/bad_input.h"
#include "models/foundation/robust_noise.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kMinute = 60, kHour = 3600;  // s
/// why: what the motor gives to change the speed is no friction, and a filter of the torque spreads it over so long.
constexpr double kBesideChange = 0.25;  // s
/// why: drives that hold a speed do so to some per cent.
constexpr double kSteady = 0.02;
/// why: by fewer a minute's rms is known to worse than a tenth.
constexpr double kFewestInMinute = 1.0 / 6;
constexpr double kAfterStart = 600;  // s
/// why: what is felt within a fifth of a second can still stop a robot.
constexpr double kAlarmWindow = 0.2;  // s
constexpr double kAlarmBlock = 10;    // s: an alarm that lasts counts once

/// Samples at a steady speed. velocity: the true one; logged: 0 at rest
SampleMask Steady(const VectorXd& velocity, const VectorXd& logged, double step) {
  const auto reach = std::max<Index>(1, std::llround(kBesideChange / step));
  SampleMask steady(velocity.size());
  const auto alike = [&](Index i, Index j) {
    j = std::clamp<Index>(j, 0, velocity.size() - 1);
    return std::abs(velocity[i] - velocity[j]) <= kSteady * std::abs(velocity[i]);
  };
  for (Index i = 0; i < velocity.size(); ++i) {
    steady[i] = logged[i] != 0 && alike(i, i - reach) && alike(i, i + reach) && alike(i, i - 1) &&
                alike(i, i + 1);
  }
  return steady;
}

double RmsOf(const VectorXd& squares, const SampleMask& of) {
  const auto count = of.count();
  return count == 0 ? CompensationScore::kNone
                    : std::sqrt(of.select(squares.array(), 0).sum() / static_cast<double>(count));
}

/// Root mean squares of blocks of so many samples, NaN where fewer than a share of them takes part.
VectorXd RmsOfBlocks(const VectorXd& squares, const SampleMask& of, Index size, double share) {
  VectorXd blocks((squares.size() + size - 1) / size);
  for (Index b = 0; b < blocks.size(); ++b) {
    const Index begin = b * size, count = std::min(size, squares.size() - begin);
    const SampleMask part = of.segment(begin, count);
    const bool enough = static_cast<double>(part.count()) >= share * static_cast<double>(size);
    blocks[b] = enough ? RmsOf(squares.segment(begin, count), part) : CompensationScore::kNone;
  }
  return blocks;
}

/// Samples within ten minutes after the log begins, and after each rest of as long.
SampleMask AfterStarts(const VectorXd& time, const VectorXd& velocity) {
  SampleMask after(time.size());
  double start = time[0], moved = time[0];
  for (Index i = 0; i < time.size(); ++i) {
    if (velocity[i] != 0) {
      if (time[i] - moved >= kAfterStart) start = time[i];
      moved = time[i];
    }
    after[i] = time[i] - start < kAfterStart;
  }
  return after;
}

/// Means of the last so many samples of `of`, 0 where fewer of them do.
VectorXd MovingMeans(const VectorXd& values, const SampleMask& of, Index size) {
  VectorXd means = VectorXd::Zero(values.size());
  double sum = 0;
  Index count = 0;
  for (Index i = 0; i < values.size(); ++i) {
    if (of[i]) sum += values[i], ++count;
    if (i >= size && of[i - size]) sum -= values[i - size], --count;
    if (count == size) means[i] = sum / static_cast<double>(size);
  }
  return means;
}

/// The level of an alarm that a free motion passes once an hour.
double SmallestPush(const VectorXd& error, const SampleMask& of, double step) {
  const VectorXd means =
      MovingMeans(error, of, std::max<Index>(1, std::llround(kAlarmWindow / step))).cwiseAbs();
  const auto size = std::max<Index>(1, std::llround(kAlarmBlock / step));
  std::vector<double> largest;
  for (Index begin = 0; begin < means.size(); begin += size) {
    largest.push_back(means.segment(begin, std::min(size, means.size() - begin)).maxCoeff());
  }
  // as many blocks as hours are passed
  const double hours = static_cast<double>(error.size()) * step / kHour;
  const auto passed = std::min(largest.size() - 1, static_cast<std::size_t>(hours));
  std::ranges::nth_element(largest, largest.begin() + static_cast<std::ptrdiff_t>(passed),
                           std::greater<>());
  return largest[passed];
}

void ScoreContact(const VectorXd& error, const VectorXd& contact, const SampleMask& steady,
                  double step, CompensationScore& score) {
  const SampleMask pushed = steady && contact.array() != 0;
  if (!pushed.any()) return;
  const VectorXd off = error - contact;
  score.contact_bias = Chosen(off, pushed).mean();
  const auto size = std::max<Index>(1, std::llround(1 / step));
  std::vector<double> means;
  for (Index begin = 0; begin + size <= off.size(); begin += size) {
    const SampleMask part = pushed.segment(begin, size);
    if (part.count() * 2 >= size) means.push_back(Chosen(off.segment(begin, size), part).mean());
  }
  std::ranges::sort(means);
  score.contact_width = (Quantile(means, 0.975) - Quantile(means, 0.025)) / 2;
}

}  // namespace

CompensationScore ScoreCompensation(const VectorXd& found, const LogSamples& log,
                                    const Truth& truth, const VectorXd& contact) {
  if (found.size() != truth.force.size() || log.size() != found.size()) {
    Refuse({"compensator"}, "gives {} samples for {} of the log", found.size(), truth.force.size());
  }
  CompensationScore score;
  if (found.size() < 3) return score;
  const double step = MedianStep(log.time);
  const SampleMask steady = Steady(truth.velocity, log.velocity, step);
  if (!steady.any()) return score;
  const VectorXd squares = (truth.force - found).array().square();
  const double percent = 100 / RmsOf(truth.force.array().square(), steady);

  score.residual = percent * RmsOf(squares, steady);
  score.by_minute =
      percent * RmsOfBlocks(squares, steady, std::max<Index>(1, std::llround(kMinute / step)),
                            kFewestInMinute);
  std::vector<double> minutes;
  for (const double one : score.by_minute) {
    if (std::isfinite(one)) minutes.push_back(one);
  }
  std::ranges::sort(minutes);
  if (!minutes.empty()) {
    score.median_minute = Quantile(minutes, 0.5);
    score.worst_minute = minutes.back();
  }
  score.after_starts = percent * RmsOf(squares, steady && AfterStarts(log.time, log.velocity));

  // what is felt of the outside: while nothing leans on the joint, and while something does
  const VectorXd error = log.torque - found;
  score.push = SmallestPush(error, steady && contact.array() == 0, step);
  ScoreContact(error, contact, steady, step, score);
  return score;
}

}  // namespace warmjoint
