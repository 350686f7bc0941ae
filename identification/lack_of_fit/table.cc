#include "identification/lack_of_fit/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <optional>

#include "identification/lack_of_fit/circumstances.h"
#include "identification/lack_of_fit/features.h"
#include "identification/lack_of_fit/lag.h"
#include "identification/lack_of_fit/remedies.h"
#include "identification/lack_of_fit/ripple.h"

namespace warmjoint {
namespace {

/// "time", whatever was found.
template <const char* const& text>
std::string Say(const Finding&, const LogSamples&) {
  return text;
}

/// "; at the log's one speed it may as well be ...", or nothing where the speeds tell. other: of that speed.
template <typename Other>
std::string OrElse(const LogSamples& measurements, Other&& other) {
  const std::optional<double> speed = OneSpeed(measurements);
  if (!speed) return "";
  return fmt::format("; the log's one speed cannot distinguish that from {}", other(*speed));
}

std::string Period(const Finding& finding, const LogSamples& measurements) {
  const auto turned = [&](double speed) {
    return fmt::format("position, period {:.3g} {}", speed * finding.period,
                       kPositionUnit.For(measurements.joint));
  };
  return fmt::format("time (periodic, {:.3g} s{})", finding.period, OrElse(measurements, turned));
}

std::string Lag(const Finding& finding, const LogSamples&) {
  return fmt::format("the time since the last change of speed (the torque lags by some {:.1g} s)",
                     finding.lag);
}

std::string Memory(const Finding& finding, const LogSamples&) {
  return fmt::format("the speed of the last {:.2g} s (friction follows the speed late)",
                     finding.period);
}

/// "2.5 Hz", of what has that period at a speed.
std::string InTime(double speed, double period) {
  return fmt::format("time, {:.3g} Hz", speed / period);
}

std::string Position(const Finding& finding, const LogSamples& measurements) {
  const bool turns = measurements.joint == JointKind::rotary;
  return fmt::format(
      "position (period {:.3g} {}{}{})", finding.period, kPositionUnit.For(measurements.joint),
      turns ? fmt::format(", {:.3g} a turn", 2 * std::numbers::pi / finding.period) : "",
      OrElse(measurements, [&](double speed) { return InTime(speed, finding.period); }));
}

std::string MotorAngle(const Finding& finding, const LogSamples& measurements) {
  const auto in_time = [&](double speed) {
    return InTime(measurements.gear * speed, finding.period);
  };
  return fmt::format("motor angle (period {:.3g} rad{})", finding.period,
                     OrElse(measurements, in_time));
}

/// "speed x motor angle (period 0.1 rad)", of what changes with both.
template <std::string (*angle)(const Finding&, const LogSamples&)>
std::string BySpeed(const Finding& finding, const LogSamples& measurements) {
  return "speed x " + angle(finding, measurements);
}

constexpr const char* kDirection = "direction";
constexpr const char* kSpeed = "speed";
constexpr const char* kEnergy = "energy (warming)";
constexpr const char* kSpeedByEnergy = "speed x energy (the slope warms)";
constexpr const char* kStart = "the energy at the start";
constexpr const char* kLoad = "load";
constexpr const char* kTemperature = "temperature";
constexpr const char* kTime = "time";
constexpr const char* kStep = "time (a step)";
constexpr const char* kParity = "the order of the holds (every other one differs)";
constexpr const char* kPhase = "the time within each hold";
constexpr const char* kFading = "position x energy (the map fades or grows as the joint warms)";

constexpr std::string_view kNoMapOrOneSpeed = "the fit has no map over it, or the log one speed";
constexpr std::string_view kNoHolds = "no segments of constant speed are known";

}  // namespace

const std::vector<LackOfFitTest>& LackOfFitTests() {
  using enum Turn;
  using enum HeatRelation;
  using enum Harm;
  static const std::vector<LackOfFitTest> tests{
      {"direction", kHeldByTheFit, first, independent, of_direction, SeenOver::velocity,
       OfDirection, Say<kDirection>, RemedyForDirection,
       "Do forward and backward motion leave different residuals?",
       "Friction differs by direction: try --set law=asymmetric, with stribeck or lugre --set "
       "law=asymmetric_stribeck or asymmetric_lugre. If gravity or a load acts, try --gravity "
       "sincos or --gravity paired."},
      {"speed", kHeldByTheFit, first, independent, of_effect, SeenOver::velocity, OfSpeed,
       Say<kSpeed>, RemedyForSpeed, "Does the residual depend on the speed?",
       "The law over speed is too simple: try --identifier stribeck, and record five speeds or "
       "more, the slowest below a twentieth of the fastest."},
      {"energy", kHeldByTheFit, first, confounded, of_drift, SeenOver::energy, OfEnergy,
       Say<kEnergy>, RemedyForWarming, "Does it depend on how warm the joint is?",
       "Warming is not followed: try --identifier energy-ml, on a log that begins cold and lasts "
       "until the torque settles."},
      {"initial_energy", "E(0) is estimated, or the fit knows no warming", first, starts, of_moves,
       SeenOver::energy, OfInitialEnergy, Say<kStart>, RemedyForStart,
       "Was the joint warm when the log began?",
       "The joint seems warm at the start: try --start estimated, or let it cool down for an hour "
       "before you record."},
      {"load", "the log has no column load", first, independent, of_moves, SeenOver::time, OfLoad,
       Say<kLoad>, RemedyForLoad, "Does it depend on the load?",
       "Friction depends on the load: record one load at a time."},
      {"temperature", "the log has no column temperature", first, independent, of_effect,
       SeenOver::time, OfTemperature, Say<kTemperature>, RemedyForTemperature,
       "Does it depend on the measured temperature?",
       "The surroundings warm the joint: record at a steady temperature."},
      {"time", kHeldByTheFit, first, confounded, of_drift, SeenOver::time, OfTime, Say<kTime>,
       RemedyForWarming, "Does it drift over time?",
       "Friction drifts: try a model that warms (--identifier energy-ml), or record for longer."},
      {"speed_by_energy", "the fit knows no warming", first, independent, of_moves,
       SeenOver::energy, OfSpeedByEnergy, Say<kSpeedByEnergy>, RemedyForWarmingSlope,
       "Does the slope over speed change with warmth?",
       "The slope changes as the joint warms: try --identifier lpv-energy."},
      {"speed_memory", "the fit knows no warming, or the segments are too long for the log", first,
       confounded, of_moves, SeenOver::time, OfSpeedMemory, Memory, RemedyForMemory,
       "Does friction follow the speed late?",
       "Friction still depends on the speed of a while ago: hold each speed for longer, so that it "
       "settles."},
      {"step", kHeldByTheFit, first, confounded, of_drift, SeenOver::time, OfStep, Say<kStep>,
       RemedyForStep, "Does it jump at some moment?",
       "Something changed in the middle of the log (load, controller, grease): record again, or "
       "cut the log there."},
      {"lag", "too few samples follow a change of speed", lag, independent, of_effect_twice,
       SeenOver::time, nullptr, Lag, RemedyForLag, "Does the torque lag changes of speed?",
       "The torque column is filtered or delayed: raise --trim, so that samples after each change "
       "of speed are left out.",
       TestLag},
      {"position_by_energy", "the fit has no map with a warming", fading, independent, of_moves,
       SeenOver::position, nullptr, Say<kFading>, RemedyForFading,
       "Does the pattern over position change with warmth?",
       "The pattern over position fades or grows as the joint warms: let the map depend on "
       "energy.",
       TestFading},
      {"position", "the log has no positions, or too short a travel for its speed", position,
       independent, of_effect, SeenOver::position, nullptr, Position, RemedyForPosition,
       "Does it repeat over position?",
       "Friction varies over position: try --identifier position-ridge, with motion over the whole "
       "travel.",
       TestRipple},
      {"motor_angle", "the log has neither a gear nor the column motor_position", motor_angle,
       independent, of_effect, SeenOver::motor_angle, nullptr, MotorAngle, RemedyForMotorAngle,
       "Does it repeat over the motor's angle?",
       "The motor or the gear ripples: give --gear or a column motor_position and try --identifier "
       "motor-ridge.",
       TestRipple},
      {"position_by_speed", kNoMapOrOneSpeed, position_by_speed, independent, of_effect,
       SeenOver::position, nullptr, BySpeed<Position>, RemedyForAngleBySpeed,
       "Does the pattern over position change with speed?",
       "The pattern over position changes with speed: let the map depend on speed (--set "
       "basis=velocity), or give it more kernels over speed.",
       TestRippleBySpeed},
      {"motor_angle_by_speed", kNoMapOrOneSpeed, motor_angle_by_speed, independent, of_effect,
       SeenOver::motor_angle, nullptr, BySpeed<MotorAngle>, RemedyForAngleBySpeed,
       "Does the pattern over the motor's angle change with speed?",
       "The motor's ripple changes with speed: give its map more kernels over speed (--set "
       "velocity_kernels).",
       TestRippleBySpeed},
      {"hold_parity", kNoHolds, hold, independent, of_either, SeenOver::time, OfHoldParity,
       Say<kParity>, RemedyForHolds, "Is every other hold of constant speed different?",
       "Holds alternate: look whether the two directions have the same load."},
      {"hold_phase", kNoHolds, hold, independent, of_either, SeenOver::time, OfHoldPhase,
       Say<kPhase>, RemedyForHolds, "Does it change within each hold of constant speed?",
       "Torque settles within each hold: raise --trim, or hold each speed for longer."},
      {"periodic", "the log is too short", last, independent, of_effect, SeenOver::time, OfPeriod,
       Period, RemedyForPeriod, "Does it repeat in time?",
       "Something repeats in time: look for a controller that swings, or another joint that "
       "moves."}};
  return tests;
}

const LackOfFitTest* FindLackOfFitTest(std::string_view name) {
  const auto& all = LackOfFitTests();
  const auto row = std::ranges::find(all, name, &LackOfFitTest::name);
  return row == all.end() ? nullptr : &*row;
}

}  // namespace warmjoint
