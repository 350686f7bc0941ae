// What helps against what the tests for lack of fit found: words, or those before a command.
#pragma once

#include <warmjoint/friction.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace warmjoint {

inline constexpr const char* kModelHasThat =
    "the model has that already, and friction follows it in another way";
inline constexpr const char* kNoFinerMap =
    "no map of this program is finer: the joint ripples in another way";
inline constexpr const char* kNoFinerMapOverSpeed =
    "no map of this program is finer over speed: record fewer speeds, each for longer";
inline constexpr const char* kRecordMoreWarmUps =
    "the map over energy does not follow it: record more than one warm-up";

// of a warming, and of a start that may have been warm
inline constexpr const char* kEstimateStart = "try --start estimated";
inline constexpr const char* kRecordFromCold =
    "record it from cold, or estimate the heat at the start: energy-ml with --start estimated";
inline constexpr const char* kWarmStartOrOneStage =
    "if the joint was warm at the start, try --start estimated; else one time constant is too few, "
    "or the surroundings change their temperature";
inline constexpr const char* kOneStageTooFew =
    "one time constant is too few, or the surroundings change their temperature; record it at a "
    "steady ambient temperature";
inline constexpr const char* kSteadyTemperature = "record it at a steady temperature";
/// The remedy for a log that is too short for a warming. duration, shortest: s
std::string RemedyForShortLog(double duration, double shortest);
/// The question about a start that was taken to be cold. remedy: kEstimateStart or kRecordFromCold
std::string AskForWarmStart(std::string_view remedy);

// of the speed
inline constexpr const char* kLawHasCurve =
    "the law has a curve over speed already, and the joint's is another one";
inline constexpr const char* kMapHasSpeed =
    "the map has kernels over speed already, and friction depends on it in another way";

// of the direction
inline constexpr const char* kLawHasBothLevels =
    "the law has a level for each direction already: they differ in slope, or in how much more the "
    "joint bears at rest";
/// The same of a fit without warming, whose directions can be identified one by one.
std::string RemedyForBothLevels();
inline constexpr const char* kMapHasDirections =
    "the map separates the directions already, and they differ in another way";
inline constexpr const char* kPushesInOneDirection =  // before a command
    "something pushes in one direction, as a load or an offset of the sensor does: ";
inline constexpr const char* kDiffersInSlope =  // before a command
    "friction differs in slope between the directions: ";

// of what acts on the joint
inline constexpr const char* kActsAsWeight =  // before a command
    "it acts as the weight of what the joint carries: ";
inline constexpr const char* kIdentifyRecordings =
    "the joint carried another weight in each recording, or was mounted in another way: identify "
    "each recording by itself";
inline constexpr const char* kMoreThanLoad =
    "the map over load does not follow it: friction depends on more than the load";
inline constexpr const char* kIdentifyPartsOfStep =
    "something changed at that moment (load, lubrication, sensor): identify the parts before and "
    "after it as recordings of their own";
inline constexpr const char* kChangesWithHolds =
    "something changes with the holds (load, settling of the drive, backlash): leave out the "
    "beginning of each hold, or log what changes as load";
inline constexpr const char* kOwnRhythm =
    "something acts on the joint in a rhythm of its own: log it as load, or record without it";
/// The same where other joints of a robot may do it, by their names.
std::string RemedyForOtherJoints(std::string_view joints);
/// The remedy for friction that follows the speed late, s: how long to hold each speed, and what to leave out of it.
std::string RemedyByLongHolds(double hold, double trim);

// of a torque that is filtered or late
inline constexpr const char* kShiftTorque = "shift it against the velocity, or log both alike";
/// What to leave out at the ends of each speed, s.
std::string RemedyByTrim(double trim);
/// The question whether the torque is late, with one of these two remedies; the next is the same before a command that may be
/// tried instead.
std::string AskForLateTorque(std::string_view remedy);
std::string AskForLateTorqueOr(std::string_view remedy);

/// Whether a ripple over position acts alike in both directions.
enum class RippleActs { alike, otherwise };
/// A text before a command: a load acts in that way.
std::string ExplainByLoad(RippleActs acts);
/// A text before a command: the ripple is that of the motor, with one of these gears, the likeliest first.
std::string ExplainByMotor(RippleActs acts, const std::vector<int>& gears);
/// A ripple that returns more often over the travel than a map can follow.
struct FineRipple {
  double periods = 0;    // over the travel
  std::size_t most = 0;  // that a map follows
  double longest = 0;    // travel that it follows, rad or m
};
/// The remedy for such a ripple: the travel to record.
std::string RemedyForFineRipple(RippleActs acts, const FineRipple& ripple, JointKind joint);

}  // namespace warmjoint
