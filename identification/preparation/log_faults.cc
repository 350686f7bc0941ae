#include "identification/preparation/log_faults.h"

namespace warmjoint::inline identification {

std::vector<std::string> FindFaults(const Measurements& measurements, const Selection& selection) {
  std::vector<std::string> faults;
  for (const auto find : {&WrappedPosition, &VelocityAgainstPosition, &TorqueSign, &ClippedTorque,
                          &StuckTorque, &DroppedTorque, &AbsurdTorque}) {
    if (auto fault = find(measurements, selection)) faults.push_back(*std::move(fault));
  }
  return faults;
}

}  // namespace warmjoint::inline identification
