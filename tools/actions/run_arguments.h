// What the command line asks of a run.
#pragma once

#include <warmjoint/suite.h>

#include "scenarios/suite.h"

namespace warmjoint {

/// The suite with what the command line changes. Throws BadInput for a command that the suite brings
/// along and nobody has agreed to.
Suite ResolveSuite(const RunArguments& arguments);

}  // namespace warmjoint
