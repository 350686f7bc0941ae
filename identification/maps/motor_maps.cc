#include "identification/maps/motor_maps.h"

#include <fmt/format.h>

#include <numbers>

#include "identification/maps/motor_harmonics.h"
#include "models/recording/measurements.h"

namespace warmjoint {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;  // rad
constexpr double kKernelsATurn = 3;             // why: mean, cosine and sine of one turn

/// The joint's map: over its travel, or over one turn.
FrictionMap ArmMap(const MotorMapSize& size, const MapOptions& settings, JointKind joint,
                   double width, const MapPoints& points) {
  FrictionMap map = PositionMap(points, settings.kernel, size.arm, width);
  const double travel = map.axes[0].kernels.centres.back() - map.axes[0].kernels.centres.front();
  if (joint == JointKind::rotary && size.arm * kTurn < kKernelsATurn * travel) {
    map.axes[0] = TurnAxis(MapQuantity::position, size.arm, width);
  }
  return map;
}

}  // namespace

std::vector<std::vector<FrictionMap>> MotorMaps(const MotorMapSize& size,
                                                const MapOptions& settings, JointKind joint,
                                                const MapPoints& points) {
  std::vector<std::vector<FrictionMap>> candidates;
  // a map over the motor's turn and speed for each width, and one over the arm where asked for
  for (const double width : settings.Widths()) {
    std::vector<FrictionMap> maps{{{TurnAxis(MapQuantity::motor_position, size.turn, width),
                                    VelocityAxis(points, size.speed, width)},
                                   settings.kernel,
                                   {}}};
    if (size.arm > 0) maps.push_back(ArmMap(size, settings, joint, width, points));
    candidates.push_back(maps);
  }
  return candidates;
}

void DescribeMotorRipple(const FrictionMap& motor, const Eigen::MatrixXd& covariance,
                         const Measurements& measurements, Fit& fit) {
  for (const int direction : {1, 0}) {
    // harmonics of one direction that stand out of the noise
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

}  // namespace warmjoint
