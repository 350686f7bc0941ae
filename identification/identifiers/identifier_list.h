// The family of identifiers: its one list.
#pragma once

#include <string>
#include <vector>

#include "identification/fit/identifier.h"

namespace warmjoint {

/// Each is described at the top of its file. For the list: who looks one up has its law within the physical bounds.
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

/// The identifier that has, or had, this name. Throws BadInput with the nearest name.
const Identifier& FindIdentifier(const std::string& name);

/// The same; nullptr where there is none.
const Identifier* LookUpIdentifier(const std::string& name);

/// The present name of an identifier; `name` itself where the list has none that has or had that name.
std::string CurrentName(const std::string& name);

}  // namespace warmjoint
