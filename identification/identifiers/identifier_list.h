// The family of identifiers: its one list.
#pragma once

#include <string>
#include <vector>

#include "identification/identifier.h"

namespace warmjoint::inline identification {

/// All identifiers: a new one is its own file pair in this folder and one line in
/// identifier_list.cc.
const std::vector<Identifier>& Identifiers();

/// The identifier of that name. Throws BadInput with the nearest name.
const Identifier& FindIdentifier(const std::string& name);

}  // namespace warmjoint::inline identification
