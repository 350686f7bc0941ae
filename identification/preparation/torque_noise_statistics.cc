#include "identification/preparation/torque_noise_statistics.h"

#include <algorithm>
#include <cmath>

namespace warmjoint {
namespace {

using Eigen::Index;

std::vector<ConstantRun> LongRuns(const Eigen::VectorXd& torque, const Selection& selection) {
  std::vector<ConstantRun> runs;
  for (Index begin = 0, end = 0; begin < torque.size(); begin = end) {
    end = begin + 1;
    while (end < torque.size() && torque[end] == torque[begin]) ++end;
    if (end - begin < kLongRun) continue;
    // only samples that a fit uses count
    const Index kept = selection.keep.segment(begin, end - begin).count();
    if (kept >= kLongRun) runs.push_back({begin, end, kept});
  }
  return runs;
}

double Share(Index part, Index whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0;
}

}  // namespace

TorqueNoiseStatistics MeasureTorqueNoise(const Measurements& measurements,
                                         const Selection& selection) {
  const Eigen::VectorXd& torque = measurements.torque;
  TorqueNoiseStatistics noise;
  noise.long_runs = LongRuns(torque, selection);

  // shares of equal steps and of turning points among kept neighbours
  const double rounding = 1e-6 * torque.cwiseAbs().maxCoeff();
  auto run = noise.long_runs.begin();
  Index pairs = 0, equal = 0, triples = 0, turning = 0;
  for (Index i = 1; i + 1 < torque.size(); ++i) {
    // long runs are judged by themselves
    if (run != noise.long_runs.end() && i >= run->begin) {
      i = run->end;
      ++run;
      continue;
    }
    if (!selection.keep[i] || !selection.keep[i + 1]) continue;
    const double step = torque[i + 1] - torque[i];
    ++pairs;
    equal += std::abs(step) <= rounding;
    // a turning point takes three samples in a row
    if (!selection.keep[i - 1]) continue;
    const double before = torque[i] - torque[i - 1];
    ++triples;
    turning += before * step < 0 && std::min(std::abs(before), std::abs(step)) > rounding;
  }
  noise.equal = Share(equal, pairs);
  noise.turning = Share(turning, triples);
  return noise;
}

}  // namespace warmjoint
