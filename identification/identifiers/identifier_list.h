// The family of identifiers: its one list.
#pragma once

#include <string>
#include <vector>

#include "identification/identifier.h"

namespace warmjoint {

/// Each is described at the top of its file.
Identifier NominalLs();
Identifier PositionRidge();
Identifier MotorRidge();
Identifier EnergyMap();
Identifier LoadMap();
Identifier LpvEnergy();
Identifier EnergyAls();
Identifier EnergyMl();
Identifier Rls();
Identifier Kalman();
Identifier StribeckIdentifier();
Identifier LuGreIdentifier();
Identifier Auto();

/// All identifiers: a new one is a file in this folder, a line above, and one in identifier_list.cc.
const std::vector<Identifier>& Identifiers();

/// The identifier that is called so, or was. Throws BadInput with the nearest name.
const Identifier& FindIdentifier(const std::string& name);

/// The same; nullptr where there is none.
const Identifier* LookUpIdentifier(const std::string& name);

/// What an identifier is called now; `name` itself where the list has none that is or was called so.
std::string CurrentName(const std::string& name);

}  // namespace warmjoint
