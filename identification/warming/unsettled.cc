#include "identification/warming/unsettled.h"

#include "identification/preparation/check.h"

namespace warmjoint::inline identification {

std::string WhyUnsettled(const Measurements& measurements, std::string_view what) {
  for (const Excitation& one : CheckRecording(measurements).excitation) {
    if (one.what.starts_with(what) && !one.sufficient) return one.reason;
  }
  return "does the torque column hold friction?";
}

}  // namespace warmjoint::inline identification
