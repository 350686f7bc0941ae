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
      {.name = "direction",
       .words = kTestOfDirection,
       .harm = of_direction,
       .over = SeenOver::velocity,
       .features = OfDirection,
       .quantity = Say<kOnDirection>,
       .remedy = RemedyForDirection},
      {.name = "speed",
       .words = kTestOfSpeed,
       .harm = of_effect,
       .over = SeenOver::velocity,
       .features = OfSpeed,
       .quantity = Say<kOnSpeed>,
       .remedy = RemedyForSpeed},
      {.name = "energy",
       .words = kTestOfEnergy,
       .warming = confounded,
       .harm = of_drift,
       .over = SeenOver::energy,
       .features = OfEnergy,
       .quantity = Say<kOnEnergy>,
       .remedy = RemedyForWarming},
      {.name = "initial_energy",
       .words = kTestOfInitialEnergy,
       .warming = starts,
       .over = SeenOver::energy,
       .features = OfInitialEnergy,
       .quantity = Say<kOnStart>,
       .remedy = RemedyForStart},
      {.name = "load",
       .words = kTestOfLoad,
       .features = OfLoad,
       .quantity = Say<kOnLoad>,
       .remedy = RemedyForLoad},
      {.name = "temperature",
       .words = kTestOfTemperature,
       .harm = of_effect,
       .features = OfTemperature,
       .quantity = Say<kOnTemperature>,
       .remedy = RemedyForTemperature},
      {.name = "time",
       .words = kTestOfTime,
       .warming = confounded,
       .harm = of_drift,
       .features = OfTime,
       .quantity = Say<kOnTime>,
       .remedy = RemedyForWarming},
      {.name = "speed_by_energy",
       .words = kTestOfSpeedByEnergy,
       .over = SeenOver::energy,
       .features = OfSpeedByEnergy,
       .quantity = Say<kOnSpeedByEnergy>,
       .remedy = RemedyForWarmingSlope},
      {.name = "speed_memory",
       .words = kTestOfSpeedMemory,
       .warming = confounded,
       .features = OfSpeedMemory,
       .quantity = Memory,
       .remedy = RemedyForMemory},
      {.name = "step",
       .words = kTestOfStep,
       .warming = confounded,
       .harm = of_drift,
       .features = OfStep,
       .quantity = Say<kOnStep>,
       .remedy = RemedyForStep},
      {.name = "lag",
       .words = kTestOfLag,
       .stage = lag,
       .harm = of_effect_twice,
       .quantity = Lag,
       .remedy = RemedyForLag,
       .at_samples = TestLag},
      {.name = "position_by_energy",
       .words = kTestOfPositionByEnergy,
       .stage = fading,
       .over = SeenOver::position,
       .quantity = Say<kOnFading>,
       .remedy = RemedyForFading,
       .at_samples = TestFading},
      {.name = "position",
       .words = kTestOfPosition,
       .stage = position,
       .harm = of_effect,
       .over = SeenOver::position,
       .quantity = Position,
       .remedy = RemedyForPosition,
       .at_samples = TestRipple},
      {.name = "motor_angle",
       .words = kTestOfMotorAngle,
       .stage = motor_angle,
       .harm = of_effect,
       .over = SeenOver::motor_angle,
       .quantity = MotorAngle,
       .remedy = RemedyForMotorAngle,
       .at_samples = TestRipple},
      {.name = "position_by_speed",
       .words = kTestOfPositionBySpeed,
       .stage = position_by_speed,
       .harm = of_effect,
       .over = SeenOver::position,
       .quantity = BySpeed<Position>,
       .remedy = RemedyForAngleBySpeed,
       .at_samples = TestRippleBySpeed},
      {.name = "motor_angle_by_speed",
       .words = kTestOfMotorAngleBySpeed,
       .stage = motor_angle_by_speed,
       .harm = of_effect,
       .over = SeenOver::motor_angle,
       .quantity = BySpeed<MotorAngle>,
       .remedy = RemedyForAngleBySpeed,
       .at_samples = TestRippleBySpeed},
      {.name = "hold_parity",
       .words = kTestOfHoldParity,
       .stage = hold,
       .harm = of_either,
       .features = OfHoldParity,
       .quantity = Say<kOnParity>,
       .remedy = RemedyForHolds},
      {.name = "hold_phase",
       .words = kTestOfHoldPhase,
       .stage = hold,
       .harm = of_either,
       .features = OfHoldPhase,
       .quantity = Say<kOnPhase>,
       .remedy = RemedyForHolds},
      {.name = "periodic",
       .words = kTestOfPeriodic,
       .stage = last,
       .harm = of_effect,
       .features = OfPeriod,
       .quantity = Period,
       .remedy = RemedyForPeriod},
  };
  return tests;
}

const LackOfFitTest* FindLackOfFitTest(std::string_view name) {
  const auto& all = LackOfFitTests();
  const auto row = std::ranges::find(all, name, &LackOfFitTest::name);
  return row == all.end() ? nullptr : &*row;
}

}  // namespace warmjoint
