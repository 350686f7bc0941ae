#include "identification/lack_of_fit/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <optional>

#include "identification/lack_of_fit/features.h"
#include "identification/lack_of_fit/one_speed.h"
#include "identification/lack_of_fit/remedies.h"

namespace warmjoint::inline identification {
namespace {

/// "time", whatever was found.
template <const char* const& text>
std::string Say(const Finding&, const Measurements&) {
  return text;
}

/// "; at the log's one speed it may as well be ...", or nothing where the speeds tell. other: of that speed.
template <typename Other>
std::string OrElse(const Measurements& measurements, Other&& other) {
  const std::optional<double> speed = OneSpeed(measurements);
  if (!speed) return "";
  return fmt::format("; the log's one speed cannot tell that from {}", other(*speed));
}

std::string Period(const Finding& finding, const Measurements& measurements) {
  const auto turned = [&](double speed) {
    return fmt::format("position, period {:.3g} {}", speed * finding.period,
                       kPositionUnit.For(measurements.joint));
  };
  return fmt::format("time (periodic, {:.3g} s{})", finding.period, OrElse(measurements, turned));
}

std::string Lag(const Finding& finding, const Measurements&) {
  return fmt::format("the time since the last change of speed (the torque lags by some {:.1g} s)",
                     finding.lag);
}

std::string Memory(const Finding& finding, const Measurements&) {
  return fmt::format("the speed of the last {:.2g} s (friction follows the speed late)",
                     finding.period);
}

/// "2.5 Hz", of what has that period at a speed.
std::string InTime(double speed, double period) {
  return fmt::format("time, {:.3g} Hz", speed / period);
}

std::string Position(const Finding& finding, const Measurements& measurements) {
  const bool turns = measurements.joint == JointKind::rotary;
  return fmt::format(
      "position (period {:.3g} {}{}{})", finding.period, kPositionUnit.For(measurements.joint),
      turns ? fmt::format(", {:.3g} a turn", 2 * std::numbers::pi / finding.period) : "",
      OrElse(measurements, [&](double speed) { return InTime(speed, finding.period); }));
}

std::string MotorAngle(const Finding& finding, const Measurements& measurements) {
  const auto in_time = [&](double speed) {
    return InTime(measurements.gear * speed, finding.period);
  };
  return fmt::format("motor angle (period {:.3g} rad{})", finding.period,
                     OrElse(measurements, in_time));
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

constexpr std::string_view kNoHolds = "no segments of constant speed are known";

}  // namespace

const std::vector<LackOfFitTest>& LackOfFitTests() {
  using enum Turn;
  using enum Warming;
  static const std::vector<LackOfFitTest> tests{
      {"direction", kHeldByTheFit, first, apart, OfDirection, Say<kDirection>, AgainstDirection},
      {"speed", kHeldByTheFit, first, apart, OfSpeed, Say<kSpeed>, AgainstSpeed},
      {"energy", kHeldByTheFit, first, takes_part, OfEnergy, Say<kEnergy>, AgainstWarming},
      {"initial_energy", "E(0) is estimated, or the fit knows no warming", first, apart,
       OfInitialEnergy, Say<kStart>, AgainstStart},
      {"load", "the log has no column load", first, apart, OfLoad, Say<kLoad>, AgainstLoad},
      {"temperature", "the log has no column temperature", first, apart, OfTemperature,
       Say<kTemperature>, AgainstTemperature},
      {"time", kHeldByTheFit, first, takes_part, OfTime, Say<kTime>, AgainstWarming},
      {"speed_by_energy", "the fit knows no warming", first, apart, OfSpeedByEnergy,
       Say<kSpeedByEnergy>, AgainstWarmingSlope},
      {"speed_memory", "the fit knows no warming, or the segments are too long for the log", first,
       apart, OfSpeedMemory, Memory, AgainstMemory},
      {"step", kHeldByTheFit, first, takes_part, OfStep, Say<kStep>, AgainstStep},
      {"lag", "too few samples follow a change of speed", sample, apart, nullptr, Lag, AgainstLag},
      {"position_by_energy", "the fit has no map beside a warming", sample, apart, nullptr,
       Say<kFading>, AgainstFading},
      {"position", "the travel is too short for the speed", sample, apart, nullptr, Position,
       AgainstPosition},
      {"motor_angle", "the log has neither a gear nor the column motor_position", sample, apart,
       nullptr, MotorAngle, AgainstMotorAngle},
      {"hold_parity", kNoHolds, hold, apart, OfHoldParity, Say<kParity>, AgainstHolds},
      {"hold_phase", kNoHolds, hold, apart, OfHoldPhase, Say<kPhase>, AgainstHolds},
      {"periodic", "the log is too short", last, apart, OfPeriod, Period, AgainstPeriod}};
  return tests;
}

namespace {

/// The row of that name, which the table has.
const LackOfFitTest& Row(std::string_view name) {
  return *std::ranges::find(LackOfFitTests(), name, &LackOfFitTest::name);
}

}  // namespace

const LackOfFitTest& LagTest() {
  static const LackOfFitTest& row = Row("lag");
  return row;
}
const LackOfFitTest& FadingTest() {
  static const LackOfFitTest& row = Row("position_by_energy");
  return row;
}
const LackOfFitTest& PositionTest() {
  static const LackOfFitTest& row = Row("position");
  return row;
}
const LackOfFitTest& MotorAngleTest() {
  static const LackOfFitTest& row = Row("motor_angle");
  return row;
}

}  // namespace warmjoint::inline identification
