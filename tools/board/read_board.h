// The leaderboard of a run directory.
#pragma once

#include "tools/board/leaderboard.h"
#include "tools/store/run_store.h"

namespace warmjoint::inline tools {

/// Sums up what the store holds, unit by unit. Throws BadInput where it was changed by others.
Leaderboard ReadBoard(const RunStore& store);

}  // namespace warmjoint::inline tools
