// Normalised kernels beside plain ones, as in the paper's Fig. 3.
#pragma once

#include "tools/figures/figure.h"

namespace warmjoint::figures {

/// 0.3 t^2 - 0.5 seen with noise on a part of its axis, and what ridge regression makes of it with
/// plain (10)-(13) and with normalised (16) kernels, beyond the data too; below, both sets of
/// kernels.
Figure MakeKernels();

}  // namespace warmjoint::figures
