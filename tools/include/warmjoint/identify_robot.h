// The friction of all joints of a robot from a description and logs: what `warmjoint identify-robot` does.
//
//   RecordingSource log{{"log.csv"}};
//   const RobotEstimate robot = IdentifyRobot("robot.urdf", log);
//   for (const RobotJointEstimate& one : robot.joints) std::puts(one.estimate.message.c_str());
#pragma once

#include <warmjoint/fields.h>
#include <warmjoint/recording.h>
#include <warmjoint/robot_estimate.h>

#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace warmjoint {

/// A number for each joint by its name; that of the empty name holds for those that are not named.
using NumberOfJoints = std::map<std::string, double>;
/// The number of a joint, or `otherwise`.
double NumberOf(const NumberOfJoints& numbers, const std::string& joint, double otherwise);

/// What is said of a load at the last link that the description lacks.
enum class ToolKnown { none, given, unknown };
inline std::span<const Word<ToolKnown>> WordsOf(ToolKnown) {
  static constexpr std::array words{Word{"none", ToolKnown::none}, Word{"given", ToolKnown::given},
                                    Word{"unknown", ToolKnown::unknown}};
  return words;
}

struct RobotTool {
  ToolKnown known = ToolKnown::none;
  double mass = 0;                         // kg, of a given one
  std::vector<double> centre = {0, 0, 0};  // m, in the axes of the last link

  template <class A>
  void Serialize(A* a) {
    a->Field("known", &known);
    a->Field("mass", &mass, {.unit = "kg", .bounds = {.at_least = 0}});
    a->Field("centre", &centre, {.unit = "m"});
    a->Check(centre.size() == 3, "centre", "three numbers");
  }
};

/// What is asked besides the log, each under the name that it has on the command line.
struct RobotSettings {
  std::vector<std::string>
      joints{};           // that the log holds, in its order; none: told by names or numbers
  NumberOfJoints gear{};  // motor turns for each of the joint; its ripple is fitted. 0: none
  double inertials = .1;  // share by which masses, their places and inertias may be wrong; 0: exact
  RobotTool tool{};
  std::vector<std::string> coupling{};  // "J6=J5+J6": that motor turns by the sum
  double cutoff = 10;                   // Hz of the zero-phase low-pass
  NumberOfJoints torque_constant{};     // N.m/A or N/A at the joint
  NumberOfJoints torque_scale{};        // factor on the torque of single joints
  NumberOfJoints position_scale{};      // the same on positions
  NumberOfJoints zero{};                // rad or m that the log reads where the description is at 0
  NumberOfJoints at{};                  // rad or m at which joints stand that the log does not hold
  /// m/s^2 in the description's axes: three numbers; none: the description's, unless the torques hold another
  std::vector<double> gravity{};
  double holdout = .4;                // share of the log's end for figures on unseen data; 0: none
  FieldSet fields = FieldSet::All();  // that each joint has

  template <class A>
  void Serialize(A* a) {
    a->Field("joints", &joints);
    a->Field("gear", &gear);
    a->Field("inertials", &inertials, {.bounds = {.at_least = 0}});
    a->Field("tool", &tool);
    a->Field("coupling", &coupling);
    a->Field("cutoff", &cutoff, {.unit = "Hz", .bounds = {.above = 0}});
    a->Field("torque_constant", &torque_constant);
    a->Field("torque_scale", &torque_scale);
    a->Field("position_scale", &position_scale);
    a->Field("zero", &zero);
    a->Field("at", &at);
    a->Field("gravity", &gravity, {.unit = "m/s^2"});
    a->Check(gravity.empty() || gravity.size() == 3, "gravity", "three numbers");
    a->Field("holdout", &holdout, {.bounds = {.at_least = 0, .at_most = .9}});
    a->Field("fields", &fields, kFieldsInfo);
  }
};

/// Is told what is being done; what it throws ends it.
using RobotWatch = std::function<void(const std::string& words)>;

/// Reads description and logs, each from a cold start, fits each joint by itself with the description as a prior, and reports all. The
/// columns are found by their names, or by patterns in source.read.map (robot_columns.h). Throws BadInput.
RobotEstimate IdentifyRobot(const std::filesystem::path& robot, const RecordingSource& source,
                            const RobotSettings& settings = {}, const RobotWatch& watch = {});

/// The same of one log in memory: its columns by their names.
RobotEstimate IdentifyRobot(const std::filesystem::path& robot,
                            const std::map<std::string, std::vector<double>>& columns,
                            const ReadSettings& read, const RobotSettings& settings = {},
                            const RobotWatch& watch = {});

}  // namespace warmjoint
