// The names and questions of the tests for lack of fit, and the names of what the residual depends on where they find something.
#pragma once

#include <warmjoint/friction.h>

#include <optional>
#include <string>
#include <string_view>

namespace warmjoint {

/// The texts of a test, whatever it finds; question and advice are for readers who do not know warmjoint.
struct TestWords {
  std::string_view absent;    // why it is not made where there are no features
  std::string_view question;  // what it asks of the residual
  std::string_view advice;    // what helps where the answer is yes
};

/// Why a test is not made whose features the fit contains already.
inline constexpr const char* kHeldByField = "a field of the fit holds it";
inline constexpr std::string_view kHeldByTheFit = "the fit holds it, or the motion never shows it";
inline constexpr std::string_view kNoMapOrOneSpeed =
    "the fit has no map over it, or the log one speed";
inline constexpr std::string_view kNoWarming = "the fit has no warming";
inline constexpr std::string_view kNoHolds = "no segments of constant speed are known";

inline constexpr TestWords kTestOfGravity{
    .absent = "the fit has gravity or a map over the position, or nothing shows the position",
    .question = "Does it depend on the position as a weight does?",
    .advice = "The joint carries its weight: try --gravity sincos."};
inline constexpr TestWords kTestOfRecording{
    .absent = "there is one recording, or the fit has neither gravity nor inertia",
    .question = "Do gravity and inertia differ between the recordings?",
    .advice = "The recordings have other weights: identify each by itself."};
inline constexpr TestWords kTestOfDirection{
    .absent = kHeldByTheFit,
    .question = "Do forward and backward motion leave different residuals?",
    .advice =
        "Friction differs by direction: try --set law=asymmetric, with stribeck or lugre --set "
        "law=asymmetric_stribeck or asymmetric_lugre. If gravity or a load acts, try --gravity "
        "sincos or --gravity paired."};
inline constexpr TestWords kTestOfSpeed{
    .absent = kHeldByTheFit,
    .question = "Does the residual depend on the speed?",
    .advice =
        "The law over speed is too simple: try --identifier stribeck, and record five speeds or "
        "more, the slowest below a twentieth of the fastest."};
inline constexpr TestWords kTestOfEnergy{
    .absent = kHeldByTheFit,
    .question = "Does it depend on how warm the joint is?",
    .advice =
        "Warming is not followed: try --identifier energy-ml, on a log that begins cold and lasts "
        "until the torque settles."};
inline constexpr TestWords kTestOfInitialEnergy{
    .absent = "the heat at the start is estimated, or the fit has no warming",
    .question = "Was the joint warm when the log began?",
    .advice =
        "The joint seems warm at the start: try --start estimated, or let it cool down for an hour "
        "before you record."};
inline constexpr TestWords kTestOfLoad{
    .absent = "the log has no column load",
    .question = "Does it depend on the load?",
    .advice = "Friction depends on the load: record one load at a time."};
inline constexpr TestWords kTestOfTemperature{
    .absent = "the log has no column temperature",
    .question = "Does it depend on the measured temperature?",
    .advice = "The surroundings warm the joint: record at a steady temperature."};
inline constexpr TestWords kTestOfTime{
    .absent = kHeldByTheFit,
    .question = "Does it drift over time?",
    .advice =
        "Friction drifts: try a model that warms (--identifier energy-ml), or record for longer."};
inline constexpr TestWords kTestOfSpeedByEnergy{
    .absent = kNoWarming,
    .question = "Does the slope over speed change with warmth?",
    .advice = "The slope changes as the joint warms: try --identifier lpv-energy."};
inline constexpr TestWords kTestOfSpeedMemory{
    .absent = "the log has no segments of constant speed that are short beside it",
    .question = "Does friction follow the speed late?",
    .advice =
        "Friction still depends on the speed of a while ago: hold each speed for longer, so that "
        "it settles."};
inline constexpr TestWords kTestOfStep{
    .absent = kHeldByTheFit,
    .question = "Does it jump at some moment?",
    .advice =
        "Something changed in the middle of the log (load, controller, grease): record again, or "
        "cut the log there."};
inline constexpr TestWords kTestOfLag{
    .absent = "too few samples follow a change of speed",
    .question = "Does the torque lag changes of speed?",
    .advice =
        "The torque column is filtered or delayed: raise --trim, so that samples after each change "
        "of speed are left out."};
inline constexpr TestWords kTestOfPositionByEnergy{
    .absent = "the fit has no map with a warming",
    .question = "Does the pattern over position change with warmth?",
    .advice =
        "The pattern over position fades or grows as the joint warms: let the map depend on "
        "energy."};
inline constexpr TestWords kTestOfPosition{
    .absent = "the log has no positions, or too short a travel for its speed",
    .question = "Does it repeat over position?",
    .advice =
        "Friction varies over position: try --identifier position-ridge, with motion over the "
        "whole travel."};
inline constexpr TestWords kTestOfMotorAngle{
    .absent = "the log has neither a gear nor the column motor_position",
    .question = "Does it repeat over the motor's angle?",
    .advice =
        "The motor or the gear ripples: give --gear or a column motor_position and try "
        "--identifier motor-ridge."};
inline constexpr TestWords kTestOfPositionBySpeed{
    .absent = kNoMapOrOneSpeed,
    .question = "Does the pattern over position change with speed?",
    .advice =
        "The pattern over position changes with speed: let the map depend on speed (--set "
        "basis=velocity), or give it more kernels over speed."};
inline constexpr TestWords kTestOfMotorAngleBySpeed{
    .absent = kNoMapOrOneSpeed,
    .question = "Does the pattern over the motor's angle change with speed?",
    .advice =
        "The motor's ripple changes with speed: give its map more kernels over speed (--set "
        "velocity_kernels)."};
inline constexpr TestWords kTestOfHoldParity{
    .absent = kNoHolds,
    .question = "Is every other hold of constant speed different?",
    .advice = "Holds alternate: look whether the two directions have the same load."};
inline constexpr TestWords kTestOfHoldPhase{
    .absent = kNoHolds,
    .question = "Does it change within each hold of constant speed?",
    .advice = "Torque settles within each hold: raise --trim, or hold each speed for longer."};
inline constexpr TestWords kTestOfPeriodic{.absent = "the log is too short",
                                           .question = "Does it repeat in time?",
                                           .advice =
                                               "Something repeats in time: look for a controller "
                                               "that swings, or another joint that moves."};

// what the residual depends on, of tests that need no number for it
inline constexpr const char* kOnGravity = "the sine of the position (gravity)";
inline constexpr const char* kOnRecording = "the recording (gravity and inertia)";
inline constexpr const char* kOnDirection = "direction";
inline constexpr const char* kOnSpeed = "speed";
inline constexpr const char* kOnEnergy = "energy (warming)";
inline constexpr const char* kOnSpeedByEnergy = "speed x energy (the slope warms)";
inline constexpr const char* kOnStart = "the energy at the start";
inline constexpr const char* kOnLoad = "load";
inline constexpr const char* kOnTemperature = "temperature";
inline constexpr const char* kOnTime = "time";
inline constexpr const char* kOnStep = "time (a step)";
inline constexpr const char* kOnParity = "the order of the holds (every other one differs)";
inline constexpr const char* kOnPhase = "the time within each hold";
inline constexpr const char* kOnFading =
    "position x energy (the map fades or grows as the joint warms)";

// the same of others. or_else: what the log's one speed cannot distinguish it from, as below; else ""
/// The name of structure that is periodic in time. period: s
std::string NameOfPeriod(double period, std::string_view or_else);
/// The name of a torque that lags; the next is that of friction that follows the speed late. lag, time: s
std::string NameOfLag(double lag);
std::string NameOfMemory(double time);
/// The name of structure that is periodic over position. period: rad or m; in_a_turn: how often it returns in a turn, of a
/// joint that turns
std::string NameOfRipple(double period, std::optional<double> in_a_turn, JointKind joint,
                         std::string_view or_else);
/// The name of structure that is periodic over the motor's angle. period: rad
std::string NameOfMotorRipple(double period, std::string_view or_else);
/// The name of ripple that changes with speed, too. angle: NameOfRipple or NameOfMotorRipple
std::string NameOfRippleBySpeed(std::string_view angle);

/// "; the log's one speed cannot distinguish that from ...": a period over position, rad or m, or a frequency, Hz.
std::string OrElsePosition(double period, JointKind joint);
std::string OrElseTime(double frequency);

}  // namespace warmjoint
