// What the store has to know of a run before it starts.
#pragma once

#include "scenarios/suite.h"
#include "tools/store/run_description.h"

namespace warmjoint {

/// The description of running `suite`, fully resolved, with this program and its libraries.
RunDescription Describe(const Suite& suite);

}  // namespace warmjoint
