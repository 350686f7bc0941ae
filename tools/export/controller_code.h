// Frictions as source code for a robot's controller: numbers of <warmjoint/compensate.h>, or of the package's Compensator.
#pragma once

#include <string>
#include <vector>

#include "tools/export/engine_friction.h"

namespace warmjoint {

/// Whether a format holds the whole friction, with heat and maps, as code that compensates it.
inline bool IsCode(EngineFormat format) {
  return format == EngineFormat::c || format == EngineFormat::cpp || format == EngineFormat::python;
}

/// c: `static const wj_friction NAME_friction` of each joint, C99; cpp: a function NAME_friction(), C++11; python: a
/// Compensator NAME_friction. Numbers have all their digits, 95 % intervals stand beside them as comments. Throws BadInput for joints
/// whose names are the same in code.
std::string CodeText(const std::vector<SeenFriction>& frictions, EngineFormat format);

}  // namespace warmjoint
