// Errors of an identifier on parts of a recording that it has not seen.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "identification/identifier.h"

namespace warmjoint {

/// Contiguous parts of a recording, each with its number of kept samples as equal as can be.
/// Returns the first sample of each, and N: [blocks + 1].
std::vector<Eigen::Index> CutIntoBlocks(const Selection& selection, int blocks);

/// Mean squared error on each block of a fit to all the others, (N.m)^2 or N^2. The samples of the
/// block are left out of the fit alone: they still warm the joint, in fit and prediction. Nothing
/// where a fit gives no friction. bounds: of CutIntoBlocks; returns [blocks].
std::optional<Eigen::VectorXd> BlockedErrors(const Identifier& identifier,
                                             const IdentifierInput& input,
                                             const std::vector<Eigen::Index>& bounds);

}  // namespace warmjoint
