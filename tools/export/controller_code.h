// Frictions as source code for a robot's controller: numbers of <warmjoint/compensate.h>, or of the package's Compensator.
#pragma once

#include <string>
#include <vector>

#include "tools/export/engine_friction.h"

namespace warmjoint {

/// c: `static const wj_friction NAME_friction` of each joint, C99; cpp: a function NAME_friction(), C++11; python: a
/// Compensator NAME_friction. Numbers have all their digits, 95 % intervals stand beside them as comments. Throws BadInput for joints
/// whose names are the same in code.
std::string CodeText(const std::vector<SeenFriction>& frictions, EngineFormat format);

/// `static const wj_friction NAME = {...};` with the arrays of its maps, C99.
std::string CFriction(const SeenFriction& seen, const std::string& name);

}  // namespace warmjoint
