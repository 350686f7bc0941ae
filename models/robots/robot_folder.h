// Where the robots and other files of the project are found at run time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace warmjoint {

/// The folder that holds models/ and scenarios/: the environment variable WARMJOINT_DATA, else
/// ../share/warmjoint beside the running program, else the source folder. Throws BadInput, naming
/// the places that were looked at, where none of them holds models/robots.
std::filesystem::path DataFolder();

/// Names of the robots of the project, sorted: each is a folder of models/robots.
std::vector<std::string> RobotNames();

/// The model file of a robot: of the project's by its name, else the path itself.
/// Throws BadInput, from the given place, with the nearest name.
std::filesystem::path FindRobot(const std::string& name_or_path, const std::string& asked_by);

}  // namespace warmjoint
