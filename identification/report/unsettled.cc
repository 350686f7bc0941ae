#include "identification/report/unsettled.h"

namespace warmjoint::inline identification {

std::string WhyUnsettled(const Measurements& measurements, FrictionKind kind) {
  for (const Excitation& one : CheckRecording(measurements).excitation) {
    if (one.kind == kind && !one.sufficient) return one.reason;
  }
  return "does the torque column hold friction?";
}

}  // namespace warmjoint::inline identification
