#include "identification/preparation/log_faults.h"

namespace warmjoint::inline identification {

std::vector<std::string> FindFaults(const Measurements& measurements, const Selection& selection) {
  const SampleFlags absurd = AbsurdTorque(measurements, selection);
  Selection left = selection;
  left.keep = left.keep && !absurd;
  std::vector<std::string> faults;
  for (const auto find : {&WrappedPosition, &VelocityAgainstPosition, &TorqueDirections,
                          &ClippedTorque, &StuckTorque, &DroppedTorque}) {
    if (auto fault = find(measurements, left)) faults.push_back(*std::move(fault));
  }
  if (absurd.any()) faults.push_back(DescribeAbsurd(measurements, absurd));
  return faults;
}

}  // namespace warmjoint::inline identification
