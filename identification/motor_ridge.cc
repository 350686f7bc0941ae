#include "identification/motor_ridge.h"

#include <fmt/format.h>

#include "identification/fit_data.h"
#include "identification/identify_maps.h"
#include "identification/motor_harmonics.h"

namespace warmjoint {
namespace {

constexpr const char* kName = "motor-ridge";

/// Arm and motor maps, for every width.
std::vector<std::vector<FrictionMap>> Candidates(const Options& options,
                                                 const MapSettings& settings,
                                                 const MapPoints& points) {
  std::vector<std::vector<FrictionMap>> candidates;
  for (const double width : settings.widths) {
    const FrictionMap motor{{MotorAxis(options.Integer("kernels"), width),
                             VelocityAxis(points, options.Integer("velocity_kernels"), width)},
                            settings.kernels,
                            {}};
    std::vector<FrictionMap> maps{motor};
    if (const int arm = options.Integer("arm_kernels"); arm > 0) {
      maps.push_back(
          {{RangeAxis(MapQuantity::position, points, arm, width), VelocityAxis(points, 1, width)},
           settings.kernels,
           {}});
    }
    candidates.push_back(maps);
  }
  return candidates;
}

/// "; ripple for v > 0: 0.052 N.m at 2 turns" and so on.
std::string Ripple(const MapFit& fit, const Uncertainty& known, const std::string& unit) {
  const auto size = static_cast<Eigen::Index>(fit.maps[0].size());
  const Eigen::MatrixXd covariance = known.covariance.block(fit.free, fit.free, size, size);
  std::string words;
  for (const int direction : {1, 0}) {
    std::vector<std::string> found;
    for (const MotorHarmonic& harmonic :
         DominantHarmonics(MotorHarmonics(fit.maps[0], covariance, direction))) {
      found.push_back(
          fmt::format("{:.3g} {} at {} a turn", harmonic.amplitude, unit, harmonic.multiple));
    }
    words += fmt::format(
        "; motor ripple for v {} 0: {}", direction ? ">" : "<",
        found.empty() ? "none above the noise" : fmt::format("{}", fmt::join(found, ", ")));
  }
  return words;
}

Estimate Identify(const IdentifierInput& input) {
  MapTask task{kName, ReadMapSettings(input.options), {}, {}};
  const Law& law = *FindLaw(task.settings.law);
  if (auto refusal = RefuseForMaps(input, kName, law)) return *refusal;
  const Measurements& m = input.measurements;
  const MapPoints points = Kept(PointsOf(m), input.selection);
  for (const MapQuantity quantity : {MapQuantity::position, MapQuantity::motor_position}) {
    if (auto why = CannotCarry(quantity, points)) return Failed(kName, Status::bad_data, *why);
  }
  task.candidates = Candidates(input.options, task.settings, points);
  const auto choice = ChooseAndFit(input, task);
  if (!choice) return Unsolvable(kName);
  const Uncertainty known = JudgeMaps(choice->problem, choice->fit);
  Estimate estimate = ReportMaps(input, task, choice->fit, known);
  if (!estimate.friction) return estimate;
  estimate.message += Ripple(choice->fit, known, m.torque_unit);
  if (m.gear == 1 && !m.motor_position) {
    estimate.message +=
        "; the motor is taken to turn with the joint: give --gear, or log "
        "motor_position";
  }
  return estimate;
}

}  // namespace

Identifier MotorRidge() {
  std::vector<OptionInfo> options = MapOptions();
  options.push_back({"kernels", "36", "integer >= 3 <= 128", "kernels over the motor's turn"});
  options.push_back({"velocity_kernels", "3", "integer >= 1 <= 64",
                     "kernels over speed for each direction, beside those over the turn"});
  options.push_back({"arm_kernels", "20", "integer >= 0 <= 128",
                     "kernels over the joint's position for each direction; 0: no such map"});
  return {kName,
          "a nominal law and maps over the motor's angle and the joint's, without warming; tells "
          "the ripple's multiples of the motor's turn",
          options, &Identify};
}

}  // namespace warmjoint
