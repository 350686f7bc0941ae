// Which identifier to trust: the results of a run, summed up.
#pragma once

#include <warmjoint/suite.h>

#include "tools/store/run_store.h"

namespace warmjoint {

/// Sums up what the store holds over all variants of its suite, and for each of them. Memory: some 70
/// bytes for each result of one identifier at a time. Throws BadInput where the database is damaged.
Leaderboard ReadBoard(const RunStore& store);

/// Whether a row of one variant has numbers that no other one is better than.
bool IsBestOrTied(const LeaderboardRow& row);

}  // namespace warmjoint
