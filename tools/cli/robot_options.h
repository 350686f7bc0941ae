// The options that say how a robot's log is to be read and what is known of it, shared by the subcommands that read one.
#pragma once

#include <warmjoint/identify_robot.h>

#include <CLI/CLI.hpp>
#include <map>
#include <string>

namespace warmjoint {

/// Adds --map, --unit, --scale, --columns, --rate, --joints and --torque-constant, each for all joints or for one by its name.
void AddRobotReading(CLI::App& parser, ReadSettings& read, RobotSettings& settings);

/// Adds --gear and --inertials, of which a fit is made.
void AddFittedRobot(CLI::App& parser, RobotSettings& settings);

/// Adds --fields.
void AddFields(CLI::App& parser, FieldSet& fields);

/// Adds --tool, --coupling and --cutoff.
void AddKnownRobot(CLI::App& parser, RobotSettings& settings);

/// Takes a factor of --scale: of "torque" or "position", or of one joint's, "J4.torque". Throws BadInput for others.
void TakeScale(const std::string& column, double factor, RobotSettings& settings);

/// Adds --joints.
void AddJointsOfLog(CLI::App& parser, RobotSettings& settings);

}  // namespace warmjoint
