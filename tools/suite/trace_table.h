// The course of an identification against the truth.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/score.h>

#include <vector>

#include "tools/store/result.h"

namespace warmjoint {

/// Each iteration's fit, its NPE in both parametrisations, Eq. (26), and its parameters. Where a
/// trace has one thermal pair alone, the other follows by Eq. (22). `score` holds the truth.
/// step: sampling interval, s.
TraceTable MakeTraceTable(const std::vector<TraceEntry>& trace, const Score& score, double step);

}  // namespace warmjoint
