// Ceres without log lines of its own.
#pragma once

namespace warmjoint::inline identification {

/// Keeps what Ceres logs below fatal errors off stderr, from the first call on. A fit says in its
/// status what became of it; Ceres would say it once more, and unasked.
void QuietCeres();

}  // namespace warmjoint::inline identification
