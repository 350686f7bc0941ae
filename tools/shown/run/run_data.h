// A run of a suite as data for the Python that draws: what its database does not say by itself.
#pragma once

#include "scenarios/suite.h"
#include "tools/shown/shown_data.h"
#include "tools/store/run_store.h"
#include "tools/suite/run_realization.h"

namespace warmjoint::shown {

/// {database, suite, identifiers[{label, method}], rungs, noise, bound, board, ...}: Python reads the results themselves from the
/// database. Throws BadInput where nothing is finished yet.
Tree RunFacts(const RunStore& store, ShownData& data);

/// RunFacts and what a page tells of the run: {..., simulated[], boards[], notes[], extremes[{rank, npe, name, fit}], ...}.
/// tell: is told what is simulated again.
Tree RunPageFacts(const RunStore& store, ShownData& data,
                  const std::function<void(const std::string&)>& tell);

/// A realization by its rank in parameter error.
struct Extreme {
  std::string rank;  // "best", "median", "worst"
  RunUnit unit;
  double npe = 0;  // continuous, 0.01 is 1 %
};

/// Of the realizations that an identifier answered, by its position in the suite: the lowest NPE, the one in the middle (of an even
/// number the lower), and the highest, each once.
std::vector<Extreme> ExtremesOf(const RunStore& store, int identifier);

/// What each realization of the suite is, one sentence each: plant, friction, motion, log, variants.
std::vector<std::string> WhatWasSimulated(const Suite& suite);

}  // namespace warmjoint::shown
