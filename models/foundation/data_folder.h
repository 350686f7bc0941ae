// Where the project's own files are found at run time: robots, suites, and the library of measured robots, whose frictions are named as library:MACHINE.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace warmjoint {

/// The folder that holds models/ and scenarios/: the environment variable WARMJOINT_DATA, else
/// ../share/warmjoint beside the running program, else the source folder. Throws BadInput, naming
/// the places that were looked at, where none of them holds models/robots.
std::filesystem::path DataFolder();

/// Names of the measured machines, sorted: each is a folder of models/library with robot.json and
/// card.json.
std::vector<std::string> MachineNames();

/// A friction of the library: the file of its machine, and a joint of that or "" for all.
struct LibraryFriction {
  std::filesystem::path file;
  std::string joint;
};

/// Whether a path names a friction of the library: library:MACHINE or library:MACHINE/JOINT.
bool IsOfLibrary(const std::filesystem::path& path);

/// What a path of the library names. Throws BadInput with the nearest name where there is no such
/// machine.
LibraryFriction FindInLibrary(const std::filesystem::path& path);

}  // namespace warmjoint
