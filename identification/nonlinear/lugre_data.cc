#include "identification/nonlinear/lugre_data.h"

#include <algorithm>
#include <cmath>

#include "identification/preparation/velocity_scale.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Mask = Eigen::Array<bool, Eigen::Dynamic, 1>;

constexpr Index kRest = 5;        // samples
constexpr double kSteady = 0.05;  // change of the speed over two samples, relative
constexpr Index kSteadySamples = 4000;

/// Samples of rests. [N]
Mask Rests(const LogSamples& m) {
  const double most = MeasureVelocity(m).Rest();
  Mask rests = Mask::Constant(m.size(), false);
  for (Index i = 0; i < m.size();) {
    // a rest is a run, long enough, in which the joint hardly moves
    Index end = i;
    while (end < m.size() && std::abs(m.velocity[end]) <= most) ++end;
    if (end - i >= kRest) rests.segment(i, end - i) = true;
    i = std::max(end, i + 1);
  }
  return rests;
}

/// The samples in order, and which of them begin a recording.
struct Grid {
  std::vector<Index> samples;
  std::vector<Index> starts;  // index into `samples`, above 0
};

/// One in `every` samples of each recording.
Grid EverySample(const LogSamples& m, Index every) {
  Grid grid;
  for (const SampleRange& one : m.Recordings()) {
    if (one.first > 0) grid.starts.push_back(static_cast<Index>(grid.samples.size()));
    for (Index i = one.first; i < one.end(); i += every) grid.samples.push_back(i);
  }
  return grid;
}

/// dv/dt between the neighbours of each sample that belong to its recording. [N]
Eigen::VectorXd Acceleration(const Eigen::VectorXd& time, const Eigen::VectorXd& velocity,
                             const std::vector<Index>& starts) {
  Eigen::VectorXd acceleration = Eigen::VectorXd::Zero(time.size());
  for (const SampleRange& one : CutAt(starts, time.size())) {
    for (Index i = one.first; i < one.end(); ++i) {
      // at the ends of a recording the difference is one-sided
      const Index before = std::max(i - 1, one.first), after = std::min(i + 1, one.end() - 1);
      if (after == before) continue;
      acceleration[i] = (velocity[after] - velocity[before]) / (time[after] - time[before]);
    }
  }
  return acceleration;
}

/// The problem on a grid. used: [N] of all samples; scale: N.m or N.
LugreProblem ProblemOn(const Grid& grid, const IdentifierInput& input, const FallingLaw& law,
                       const Mask& used, double scale) {
  const LogSamples& m = input.measurements;
  // at rest the velocity is 0, and constant speed has no acceleration
  const Eigen::VectorXd still = Rests(m).select(0.0, m.velocity.array());
  const Eigen::VectorXd time = m.time(grid.samples);
  Eigen::VectorXd acceleration = Acceleration(time, m.velocity(grid.samples), grid.starts);
  if (!input.selection.segments.empty()) {
    for (Index i = 0; i < time.size(); ++i) {
      if (input.selection.keep[grid.samples[static_cast<size_t>(i)]]) acceleration[i] = 0;
    }
  }
  const Mask use = used(grid.samples);
  return {MotionPieces(time, still(grid.samples), grid.starts),
          std::move(acceleration),
          m.torque(grid.samples),
          {use, {}},
          Eigen::VectorXd::Constant(use.count(), scale),
          {},
          &law};
}

}  // namespace

LugreProblem MakeLugreProblem(const IdentifierInput& input, const FallingLaw& law, double scale) {
  const LogSamples& m = input.measurements;
  const Mask& keep = input.selection.keep;
  const Mask rests = Rests(m);

  // each recording from its first kept sample to the last one
  Mask used = Mask::Constant(m.size(), false);
  for (const SampleRange& one : m.Recordings()) {
    Index first = one.first, last = one.end() - 1;
    while (first <= last && !keep[first]) ++first;
    while (last > first && !keep[last]) --last;
    if (first > last) continue;
    const Index n = last - first + 1;
    // samples of rests are left out unless they are kept
    used.segment(first, n) = keep.segment(first, n) || !rests.segment(first, n);
  }
  return ProblemOn(EverySample(m, 1), input, law, used, scale);
}

HalvedProblem Halve(const IdentifierInput& input, const LugreProblem& problem) {
  Grid grid = EverySample(input.measurements, 2);
  LugreProblem halved = ProblemOn(grid, input, *problem.law, problem.used.keep, 1);
  return {std::move(grid.samples), std::move(halved)};
}

Selection SteadySamples(const IdentifierInput& input, double distance) {
  const LogSamples& m = input.measurements;
  const Eigen::VectorXd& v = m.velocity;
  Selection steady{Mask::Constant(m.size(), false), {}};
  double travelled = 0;  // since the last turn
  // bristles are steady some presliding distances after a turn, where the speed hardly changes
  for (Index i = 1; i + 1 < m.size(); ++i) {
    travelled = v[i] * v[i - 1] > 0
                    ? travelled + 0.5 * std::abs(v[i] + v[i - 1]) * (m.time[i] - m.time[i - 1])
                    : 0;
    const double most = kSteady * std::abs(v[i]);
    steady.keep[i] = input.selection.keep[i] && travelled >= 4 * distance &&
                     std::abs(v[i + 1] - v[i]) <= most && std::abs(v[i - 1] - v[i]) <= most;
  }

  // one in so many of them
  const Index every = 1 + steady.count() / kSteadySamples;
  Index seen = 0;
  for (Index i = 0; i < m.size() && every > 1; ++i) {
    if (steady.keep[i]) steady.keep[i] = seen++ % every == 0;
  }
  return steady;
}

}  // namespace warmjoint
