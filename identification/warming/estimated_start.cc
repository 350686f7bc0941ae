#include "identification/warming/estimated_start.h"

#include "identification/find_parameter.h"
#include "identification/warming/gaps.h"

namespace warmjoint {

ThermalStart StartOf(const Estimate& estimate, const LogSamples& measurements) {
  ThermalStart start;
  start.energy = ValueOf(Role::start, estimate).value_or(0);
  // each gap and each further recording has its own, 0 where none was estimated
  const std::vector<LogGap> gaps = Merged(FindGaps(measurements), FurtherStarts(measurements));
  const std::vector<std::string> names = JumpNames(gaps, measurements);
  for (size_t i = 0; i < gaps.size(); ++i) {
    const EstimatedParameter* found = estimate.Find(names[i]);
    if (found) start.jumps.push_back({gaps[i].behind, found->value});
  }
  return start;
}

}  // namespace warmjoint
