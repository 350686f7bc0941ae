#include "identification/warming/estimated_start.h"

#include "identification/find_parameter.h"
#include "identification/warming/gaps.h"

namespace warmjoint {

CourseStart StartOf(const Estimate& estimate, const Measurements& measurements) {
  CourseStart start;
  if (const EstimatedParameter* found = Find(Role::start, estimate)) {
    start.energy = found->value;
  }
  // each gap and each further recording has its own, 0 where none was estimated
  int gap = 0, recording = 1;
  for (const LogGap& at : Merged(FindGaps(measurements), FurtherStarts(measurements))) {
    const EstimatedParameter* found =
        IsStart(at) ? Find(Role::start, estimate, recording++) : Find(Role::jump, estimate, gap++);
    if (found) start.jumps.push_back({at.behind, found->value});
  }
  return start;
}

}  // namespace warmjoint
