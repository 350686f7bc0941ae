// The sentences about the joints of a robot. The code that makes a row (Cause) brings their numbers and conditions.
#pragma once

#include <warmjoint/friction.h>

#include <string>
#include <vector>

namespace warmjoint {

struct JointColumns;
struct JointFit;

/// The summary of a joint's fit: a clause that begins the message.
std::string SummaryOfJoint(const JointFit& fit, const JointColumns& columns);

// why a joint has no numbers. travel: rad or m; counts of samples
std::string ExplainDidNotMove(const std::string& joint, double travel, JointKind kind);
std::string ExplainLittleMotion(const std::string& joint, long samples, long needed);
std::string ExplainOneDirection(const std::string& joint);

// why its numbers mean nothing
std::string ExplainBeyond(const std::vector<std::string>& rows);

// what a reader has to know in addition to the numbers
std::string ExplainTurnedTorque(const std::string& joint);
inline constexpr const char* kAllTorquesTurned =
    "the torques of all joints drive their motion where friction would brake: their signs are "
    "taken "
    "to be turned (--scale torque=-1)";
/// delay: s
std::string ExplainDelayOfAll(double delay, double deviation);
std::string ExplainTurnedSign(const std::string& joint);
std::string ExplainWrongDescription(const std::string& joint, double times);
// gains: of the log's torque over that of the description
std::string ExplainScaleOfAll(double gain);
std::string ExplainScale(const std::string& joint, double gain);
std::string ExplainDoubtfulGain(const std::string& joint, double gain);
std::string ExplainOffset(const std::string& joint, double value, double reach,
                          const std::string& unit);
std::string ExplainUnknownGain(const std::string& joint);
inline constexpr const char* kNegativeRotor =
    "the rotor's inertia is below 0: the torque may be late against the position, or the links "
    "lighter than described; --cutoff lower makes it matter less";
inline constexpr const char* kStillMoving = "the fit still moved when it was stopped";

}  // namespace warmjoint
