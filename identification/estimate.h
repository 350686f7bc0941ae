// Estimates as trees of files.
#pragma once

#include <warmjoint/estimate.h>

#include "models/foundation/node.h"

namespace warmjoint {

/// The estimate as a file in `target`'s folder has it; empty: recordings are named as they are.
Tree EstimateToTree(Estimate estimate, const std::filesystem::path& target = {});

/// The common part of EstimateFromJson and ReadEstimate, after parsing.
Estimate EstimateFrom(const Node& node);

}  // namespace warmjoint
