#include "identification/preparation/log_faults.h"

namespace warmjoint {

std::vector<std::string> FindFaults(const Measurements& measurements, const Selection& selection,
                                    MotionSource source) {
  const SampleFlags absurd = AbsurdTorque(measurements, selection);
  Selection left = selection;
  left.keep = left.keep && !absurd;
  std::vector<std::string> faults;
  for (const auto find : {&WrappedPosition, &VelocityAgainstPosition, &TorqueDirections,
                          &ClippedTorque, &StuckTorque, &DroppedTorque}) {
    if (source == MotionSource::positions && find == &VelocityAgainstPosition) continue;
    if (auto fault = find(measurements, left)) faults.push_back(*std::move(fault));
  }
  if (!absurd.any()) return faults;
  faults.push_back(DescribeAbsurd(measurements, absurd) +
                   "; cut that out, or take a loss that leaves it out (--set loss=huber, of "
                   "energy-ml and nominal-ls)");
  return faults;
}

}  // namespace warmjoint
