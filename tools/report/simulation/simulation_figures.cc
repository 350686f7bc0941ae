#include "tools/report/simulation/simulation_figures.h"

#include "tools/report/figures/envelope.h"
#include "tools/report/figures/friction_map.h"
#include "tools/report/figures/motor_angle.h"

namespace warmjoint::report {
namespace {

std::optional<Figure> EnvelopeOf(const SimulationView& view) {
  if (!view.recording.truth.friction.thermal) return std::nullopt;
  return MakeEnvelope(view.scenario.name, view.recording.measurements, view.fit.selection,
                      view.recording.truth.friction.thermal);
}

std::optional<Figure> MotorAngleOf(const SimulationView& view) { return MakeMotorAngle(view.fit); }

std::optional<Figure> FrictionMapOf(const SimulationView& view) {
  return MakeFrictionMap(view.fit);
}

}  // namespace

const std::vector<SimulationFigure>& SimulationFigures() {
  static const std::vector<SimulationFigure> figures{
      {"envelope", "the recording's envelope and the first guess beside the truth", &EnvelopeOf,
       "friction that warms"},
      {"motor_angle", "torque over motor angle", &MotorAngleOf, "a gear"},
      {"friction_map", "friction over angle and velocity, cold and warm", &FrictionMapOf,
       "a map over position or the motor's angle"},
  };
  return figures;
}

}  // namespace warmjoint::report
