#include "identification/lack_of_fit/table.h"

#include <algorithm>
#include <numbers>
#include <optional>

#include "identification/lack_of_fit/circumstances.h"
#include "identification/lack_of_fit/features.h"
#include "identification/lack_of_fit/lag.h"
#include "identification/lack_of_fit/remedies.h"
#include "identification/lack_of_fit/ripple.h"
#include "identification/sentences/findings.h"

namespace warmjoint {
namespace {

/// Returns a fixed text such as "time", whatever was found.
template <const char* const& text>
std::string Say(const Finding&, const LogSamples&) {
  return text;
}

std::string Period(const Finding& finding, const LogSamples& measurements) {
  const std::optional<double> speed = OneSpeed(measurements);
  return NameOfPeriod(finding.period,
                      speed ? OrElsePosition(*speed * finding.period, measurements.joint) : "");
}

std::string Lag(const Finding& finding, const LogSamples&) { return NameOfLag(finding.lag); }

std::string Memory(const Finding& finding, const LogSamples&) {
  return NameOfMemory(finding.period);
}

std::string Position(const Finding& finding, const LogSamples& measurements) {
  std::optional<double> in_a_turn;
  if (measurements.joint == JointKind::rotary) in_a_turn = 2 * std::numbers::pi / finding.period;
  const std::optional<double> speed = OneSpeed(measurements);
  return NameOfRipple(finding.period, in_a_turn, measurements.joint,
                      speed ? OrElseTime(*speed / finding.period) : "");
}

std::string MotorAngle(const Finding& finding, const LogSamples& measurements) {
  const std::optional<double> speed = OneSpeed(measurements);
  return NameOfMotorRipple(finding.period,
                           speed ? OrElseTime(measurements.gear * *speed / finding.period) : "");
}

/// Returns a text such as "speed x motor angle (period 0.1 rad)", for ripple that changes with both.
template <std::string (*angle)(const Finding&, const LogSamples&)>
std::string BySpeed(const Finding& finding, const LogSamples& measurements) {
  return NameOfRippleBySpeed(angle(finding, measurements));
}

}  // namespace

const std::vector<LackOfFitTest>& LackOfFitTests() {
  using enum Stage;
  using enum HeatRelation;
  using enum Impact;
  static const std::vector<LackOfFitTest> tests{
      {.name = "gravity",
       .words = kTestOfGravity,
       .quantity = Say<kOnGravity>,
       .remedy = RemedyForGravity,
       .harm = of_effect,
       .over = SeenOver::position,
       .features = OfGravity},
      {.name = "recording",
       .words = kTestOfRecording,
       .quantity = Say<kOnRecording>,
       .remedy = RemedyForRecording,
       .features = OfRecording},
      {.name = "direction",
       .words = kTestOfDirection,
       .quantity = Say<kOnDirection>,
       .remedy = RemedyForDirection,
       .harm = of_direction,
       .over = SeenOver::velocity,
       .in_field = FieldKind::place_torque,
       .features = OfDirection},
      {.name = "speed",
       .words = kTestOfSpeed,
       .quantity = Say<kOnSpeed>,
       .remedy = RemedyForSpeed,
       .harm = of_effect,
       .over = SeenOver::velocity,
       .in_field = FieldKind::speed_friction,
       .features = OfSpeed},
      {.name = "energy",
       .words = kTestOfEnergy,
       .quantity = Say<kOnEnergy>,
       .remedy = RemedyForWarming,
       .warming = confounded,
       .harm = of_drift,
       .over = SeenOver::energy,
       .in_field = FieldKind::time_friction,
       .features = OfEnergy},
      {.name = "initial_energy",
       .words = kTestOfInitialEnergy,
       .quantity = Say<kOnStart>,
       .remedy = RemedyForStart,
       .warming = starts,
       .over = SeenOver::energy,
       .features = OfInitialEnergy},
      {.name = "load",
       .words = kTestOfLoad,
       .quantity = Say<kOnLoad>,
       .remedy = RemedyForLoad,
       .features = OfLoad},
      {.name = "temperature",
       .words = kTestOfTemperature,
       .quantity = Say<kOnTemperature>,
       .remedy = RemedyForTemperature,
       .harm = of_effect,
       .in_field = FieldKind::temperature_friction,
       .features = OfTemperature},
      {.name = "time",
       .words = kTestOfTime,
       .quantity = Say<kOnTime>,
       .remedy = RemedyForWarming,
       .warming = confounded,
       .harm = of_drift,
       .in_field = FieldKind::time_friction,
       .features = OfTime},
      {.name = "speed_by_energy",
       .words = kTestOfSpeedByEnergy,
       .quantity = Say<kOnSpeedByEnergy>,
       .remedy = RemedyForWarmingSlope,
       .over = SeenOver::energy,
       .features = OfSpeedByEnergy},
      {.name = "speed_memory",
       .words = kTestOfSpeedMemory,
       .quantity = Memory,
       .remedy = RemedyForMemory,
       .warming = confounded,
       .features = OfSpeedMemory},
      {.name = "step",
       .words = kTestOfStep,
       .quantity = Say<kOnStep>,
       .remedy = RemedyForStep,
       .warming = confounded,
       .harm = of_drift,
       .in_field = FieldKind::time_friction,
       .features = OfStep},
      {.name = "lag",
       .words = kTestOfLag,
       .quantity = Lag,
       .remedy = RemedyForLag,
       .stage = lag,
       .harm = of_effect_twice,
       .at_samples = TestLag},
      {.name = "position_by_energy",
       .words = kTestOfPositionByEnergy,
       .quantity = Say<kOnFading>,
       .remedy = RemedyForFading,
       .stage = fading,
       .over = SeenOver::position,
       .at_samples = TestFading},
      {.name = "position",
       .words = kTestOfPosition,
       .quantity = Position,
       .remedy = RemedyForPosition,
       .stage = position,
       .harm = of_effect,
       .over = SeenOver::position,
       .in_field = FieldKind::place_friction,
       .at_samples = TestRipple},
      {.name = "motor_angle",
       .words = kTestOfMotorAngle,
       .quantity = MotorAngle,
       .remedy = RemedyForMotorAngle,
       .stage = motor_angle,
       .harm = of_effect,
       .over = SeenOver::motor_angle,
       .in_field = FieldKind::place_friction,
       .at_samples = TestRipple},
      {.name = "position_by_speed",
       .words = kTestOfPositionBySpeed,
       .quantity = BySpeed<Position>,
       .remedy = RemedyForAngleBySpeed,
       .stage = position_by_speed,
       .harm = of_effect,
       .over = SeenOver::position,
       .in_field = FieldKind::place_friction,
       .at_samples = TestRippleBySpeed},
      {.name = "motor_angle_by_speed",
       .words = kTestOfMotorAngleBySpeed,
       .quantity = BySpeed<MotorAngle>,
       .remedy = RemedyForAngleBySpeed,
       .stage = motor_angle_by_speed,
       .harm = of_effect,
       .over = SeenOver::motor_angle,
       .in_field = FieldKind::place_friction,
       .at_samples = TestRippleBySpeed},
      {.name = "hold_parity",
       .words = kTestOfHoldParity,
       .quantity = Say<kOnParity>,
       .remedy = RemedyForHolds,
       .stage = hold,
       .harm = of_either,
       .features = OfHoldParity},
      {.name = "hold_phase",
       .words = kTestOfHoldPhase,
       .quantity = Say<kOnPhase>,
       .remedy = RemedyForHolds,
       .stage = hold,
       .harm = of_either,
       .features = OfHoldPhase},
      {.name = "periodic",
       .words = kTestOfPeriodic,
       .quantity = Period,
       .remedy = RemedyForPeriod,
       .stage = last,
       .harm = of_effect,
       .in_field = FieldKind::time_torque,
       .features = OfPeriod},
  };
  return tests;
}

const LackOfFitTest* FindLackOfFitTest(std::string_view name) {
  const auto& all = LackOfFitTests();
  const auto row = std::ranges::find(all, name, &LackOfFitTest::name);
  return row == all.end() ? nullptr : &*row;
}

}  // namespace warmjoint
