// An aim as files have it.
#pragma once

#include <warmjoint/design.h>

#include "models/foundation/node.h"

namespace warmjoint {

void ReadValue(const Node& node, DesignAim* value, const FieldInfo& info);
Tree WriteValue(const DesignAim& aim);

}  // namespace warmjoint
