#include "tools/figures/run/simulation_figures.h"

#include "tools/figures/envelope.h"
#include "tools/figures/friction_map.h"
#include "tools/figures/motor_angle.h"

namespace warmjoint::figures {
namespace {

std::optional<Figure> EnvelopeOf(const SimulationView& view) {
  const Friction& friction = view.recording.truth.friction;
  if (!friction.thermal || !friction.maps.empty()) return std::nullopt;
  return MakeEnvelope(view.scenario.name, view.recording.measurements, view.fit.selection,
                      friction.thermal);
}

std::optional<Figure> MotorAngleOf(const SimulationView& view) { return MakeMotorAngle(view.fit); }

std::optional<Figure> FrictionMapOf(const SimulationView& view) {
  return MakeFrictionMap(view.fit);
}

}  // namespace

const std::vector<SimulationFigure>& SimulationFigures() {
  static const std::vector<SimulationFigure> figures{
      {"envelope", "the recording's envelope and the first guess beside the truth", &EnvelopeOf,
       "friction that warms, at constant speeds, without maps or gravity"},
      {"motor_angle", "torque over motor angle", &MotorAngleOf, "a gear"},
      {"friction_map", "friction over angle and velocity, cold and warm", &FrictionMapOf,
       "a map over position or the motor's angle"},
  };
  return figures;
}

}  // namespace warmjoint::figures
