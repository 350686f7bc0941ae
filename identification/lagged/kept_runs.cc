#include "identification/lagged/kept_runs.h"

#include <set>

#include "models/foundation/robust_noise.h"

namespace warmjoint {

double KeptRuns::Step() const {
  std::vector<double> steps;
  for (const KeptRun& run : runs) {
    for (Eigen::Index i = run.begin + 1; i < run.end; ++i) steps.push_back(time[i] - time[i - 1]);
  }
  return MedianOf(steps);
}

double KeptRuns::Duration() const {
  std::vector<double> durations;
  for (const KeptRun& run : runs) durations.push_back(time[run.end - 1] - time[run.begin]);
  return MedianOf(durations);
}

KeptRuns FindRuns(const LogSamples& m, const Selection& selection) {
  // where a run ends although no sample is left out
  std::set<Eigen::Index> breaks(m.further_starts.begin(), m.further_starts.end());
  for (const Segment& segment : selection.segments) breaks.insert(segment.begin);

  KeptRuns found;
  for (Eigen::Index i = 0; i < selection.keep.size(); ++i) {
    if (!selection.keep[i]) continue;
    // a sample that is left out ends the run as well
    const bool goes_on = !found.samples.empty() && found.samples.back() == i - 1;
    if (!goes_on || breaks.contains(i)) found.runs.push_back({found.count(), found.count()});
    found.samples.push_back(i);
    found.runs.back().end = found.count();
  }

  // when the kept samples were taken
  found.time.resize(found.count());
  for (Eigen::Index i = 0; i < found.count(); ++i) {
    found.time[i] = m.time[found.samples[static_cast<std::size_t>(i)]];
  }
  return found;
}

}  // namespace warmjoint
