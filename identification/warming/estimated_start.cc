#include "identification/warming/estimated_start.h"

#include <fmt/format.h>

#include "identification/warming/gaps.h"

namespace warmjoint::inline identification {

CourseStart StartOf(const Estimate& estimate, const Measurements& measurements) {
  CourseStart start;
  if (const EstimatedParameter* found = estimate.Find("initial_energy")) {
    start.energy = found->value;
  }
  if (!estimate.Find("energy_jump_1")) return start;
  const std::vector<LogGap> gaps = FindGaps(measurements);
  for (size_t i = 0; i < gaps.size(); ++i) {
    const EstimatedParameter* jump = estimate.Find(fmt::format("energy_jump_{}", i + 1));
    start.jumps.push_back({gaps[i].behind, jump ? jump->value : 0});
  }
  return start;
}

}  // namespace warmjoint::inline identification
