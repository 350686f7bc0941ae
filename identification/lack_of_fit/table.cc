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
      {"direction", kTestOfDirection, first, independent, of_direction, SeenOver::velocity,
       OfDirection, Say<kOnDirection>, RemedyForDirection},
      {"speed", kTestOfSpeed, first, independent, of_effect, SeenOver::velocity, OfSpeed,
       Say<kOnSpeed>, RemedyForSpeed},
      {"energy", kTestOfEnergy, first, confounded, of_drift, SeenOver::energy, OfEnergy,
       Say<kOnEnergy>, RemedyForWarming},
      {"initial_energy", kTestOfInitialEnergy, first, starts, of_moves, SeenOver::energy,
       OfInitialEnergy, Say<kOnStart>, RemedyForStart},
      {"load", kTestOfLoad, first, independent, of_moves, SeenOver::time, OfLoad, Say<kOnLoad>,
       RemedyForLoad},
      {"temperature", kTestOfTemperature, first, independent, of_effect, SeenOver::time,
       OfTemperature, Say<kOnTemperature>, RemedyForTemperature},
      {"time", kTestOfTime, first, confounded, of_drift, SeenOver::time, OfTime, Say<kOnTime>,
       RemedyForWarming},
      {"speed_by_energy", kTestOfSpeedByEnergy, first, independent, of_moves, SeenOver::energy,
       OfSpeedByEnergy, Say<kOnSpeedByEnergy>, RemedyForWarmingSlope},
      {"speed_memory", kTestOfSpeedMemory, first, confounded, of_moves, SeenOver::time,
       OfSpeedMemory, Memory, RemedyForMemory},
      {"step", kTestOfStep, first, confounded, of_drift, SeenOver::time, OfStep, Say<kOnStep>,
       RemedyForStep},
      {"lag", kTestOfLag, lag, independent, of_effect_twice, SeenOver::time, nullptr, Lag,
       RemedyForLag, TestLag},
      {"position_by_energy", kTestOfPositionByEnergy, fading, independent, of_moves,
       SeenOver::position, nullptr, Say<kOnFading>, RemedyForFading, TestFading},
      {"position", kTestOfPosition, position, independent, of_effect, SeenOver::position, nullptr,
       Position, RemedyForPosition, TestRipple},
      {"motor_angle", kTestOfMotorAngle, motor_angle, independent, of_effect, SeenOver::motor_angle,
       nullptr, MotorAngle, RemedyForMotorAngle, TestRipple},
      {"position_by_speed", kTestOfPositionBySpeed, position_by_speed, independent, of_effect,
       SeenOver::position, nullptr, BySpeed<Position>, RemedyForAngleBySpeed, TestRippleBySpeed},
      {"motor_angle_by_speed", kTestOfMotorAngleBySpeed, motor_angle_by_speed, independent,
       of_effect, SeenOver::motor_angle, nullptr, BySpeed<MotorAngle>, RemedyForAngleBySpeed,
       TestRippleBySpeed},
      {"hold_parity", kTestOfHoldParity, hold, independent, of_either, SeenOver::time, OfHoldParity,
       Say<kOnParity>, RemedyForHolds},
      {"hold_phase", kTestOfHoldPhase, hold, independent, of_either, SeenOver::time, OfHoldPhase,
       Say<kOnPhase>, RemedyForHolds},
      {"periodic", kTestOfPeriodic, last, independent, of_effect, SeenOver::time, OfPeriod, Period,
       RemedyForPeriod}};
  return tests;
}

const LackOfFitTest* FindLackOfFitTest(std::string_view name) {
  const auto& all = LackOfFitTests();
  const auto row = std::ranges::find(all, name, &LackOfFitTest::name);
  return row == all.end() ? nullptr : &*row;
}

}  // namespace warmjoint
