#include "identification/maps/motor_maps.h"

#include <fmt/format.h>

#include "identification/maps/motor_harmonics.h"
#include "identification/maps/position_maps.h"
#include "models/recording/motor_angle.h"

namespace warmjoint::inline identification {

std::vector<std::vector<FrictionMap>> MotorMaps(const MotorMapSize& size,
                                                const MapSettings& settings,
                                                const MapPoints& points) {
  std::vector<std::vector<FrictionMap>> candidates;
  for (const double width : settings.widths) {
    std::vector<FrictionMap> maps{
        {{MotorAxis(size.turn, width), VelocityAxis(points, size.speed, width)},
         settings.kernels,
         {}}};
    if (size.arm > 0) maps.push_back(PositionMap(points, settings.kernels, size.arm, width));
    candidates.push_back(maps);
  }
  return candidates;
}

void DescribeMotorRipple(const FrictionMap& motor, const Eigen::MatrixXd& covariance,
                         const Measurements& measurements, Fit& fit) {
  for (const int direction : {1, 0}) {
    std::vector<std::string> found;
    for (const MotorHarmonic& harmonic :
         DominantHarmonics(MotorHarmonics(motor, covariance, direction))) {
      found.push_back(fmt::format("{:.3g} {} at {} a turn", harmonic.amplitude,
                                  measurements.torque_unit, harmonic.multiple));
    }
    fit.afterword += fmt::format(
        "; motor ripple for v {} 0: {}", direction ? ">" : "<",
        found.empty() ? "none above the noise" : fmt::format("{}", fmt::join(found, ", ")));
  }
  if (!KnowsMotorAngle(measurements)) {
    fit.warnings.emplace_back(
        "the motor is taken to turn with the joint: give --gear, or log motor_position");
  }
}

}  // namespace warmjoint::inline identification
