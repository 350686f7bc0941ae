// Frictions as an FMU 3.0 for co-simulation: its files, but for the library that a C compiler makes of them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tools/export/engine_friction.h"

namespace warmjoint {

/// What an FMU holds: the text of each file by its path in it, and the name of its library.
struct FmuFiles {
  std::string model;  // modelIdentifier
  std::map<std::string, std::string> files;
};

/// modelDescription.xml, and in sources/ the code of <warmjoint/compensate.h> with the numbers. Each joint has inputs velocity,
/// torque, position, load and ambient_rise, outputs compensation, friction, residual, energy, std and contact, and its numbers as
/// parameters with their 95 % intervals in the descriptions; names begin with the joint's where there are several. Throws
/// BadInput for joints whose names are the same in code.
FmuFiles FmuFilesOf(const std::vector<SeenFriction>& frictions);

}  // namespace warmjoint
