// Whether a log holds enough, and how much more of the same it takes.
#pragma once

#include <warmjoint/design.h>
#include <warmjoint/prepared_log.h>

#include <functional>

#include "tools/design/motion_plan.h"

namespace warmjoint {

/// The motion of a log over even cells; samples that fits at constant speed leave out count as passed, not as held.
MotionCells CellsOf(const LogView& log, double length);

/// The log's cells again and again, from its end on.
MotionCells Repeated(const MotionCells& cells, double seconds);

}  // namespace warmjoint
