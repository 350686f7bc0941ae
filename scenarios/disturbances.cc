#include "scenarios/disturbances.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace warmjoint {

double AmbientTemperature::RiseAt(double t) const {
  return amplitude == 0 ? 0 : amplitude * std::sin(2 * std::numbers::pi * t / period);
}

bool Disturbances::operator==(const Disturbances& other) const {
  const auto heat = [](const std::optional<Thermal>& thermal) {
    return std::pair{thermal ? thermal->gain : 0, thermal ? thermal->time_constant : 0};
  };
  return outliers == other.outliers && coloured_noise == other.coloured_noise &&
         uneven_noise == other.uneven_noise && periodic_torque == other.periodic_torque &&
         gravity == other.gravity && ambient_drift == other.ambient_drift &&
         load_change == other.load_change && ambient_temperature == other.ambient_temperature &&
         torque_lag == other.torque_lag && velocity_filter == other.velocity_filter &&
         stale_position == other.stale_position && encoder == other.encoder &&
         hold_parity == other.hold_parity && step_in_time == other.step_in_time &&
         run_in == other.run_in && hidden == other.hidden && faults == other.faults &&
         without_velocity == other.without_velocity && heat(second_heat) == heat(other.second_heat);
}

std::string_view IdealOnly(const Disturbances& disturbances) {
  if (disturbances.gravity != Gravity{}) return "gravity";
  if (disturbances.ambient_drift != AmbientDrift{}) return "ambient_drift";
  if (disturbances.load_change != LoadChange{}) return "load_change";
  if (disturbances.second_heat) return "second_heat";
  return "";
}

}  // namespace warmjoint
