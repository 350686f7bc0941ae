#include "identification/warming/estimated_start.h"

#include "identification/find_parameter.h"
#include "identification/warming/gaps.h"

namespace warmjoint {

CourseStart StartOf(const Estimate& estimate, const Measurements& measurements) {
  CourseStart start;
  if (const EstimatedParameter* found = Find(Role::start, estimate)) {
    start.energy = found->value;
  }
  if (!Find(Role::jump, estimate)) return start;
  // each gap has its jump, 0 where none was estimated
  const std::vector<LogGap> gaps = FindGaps(measurements);
  for (size_t i = 0; i < gaps.size(); ++i) {
    const EstimatedParameter* jump = Find(Role::jump, estimate, static_cast<int>(i));
    start.jumps.push_back({gaps[i].behind, jump ? jump->value : 0});
  }
  return start;
}

}  // namespace warmjoint
