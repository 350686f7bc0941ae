// Identifier `energy-als`: Algorithm 1 of the paper, which are alternating least squares.
#pragma once

#include "identification/identifier.h"

namespace warmjoint::inline identification {

/// Alternating least squares, a block-coordinate descent on |tau - Fn(v) - sign(v) E|^2 with
/// E = H W, W = |tau v| (19):
///   0. E from the start H0, Fn by (24); then repeat
///   1. E by (23)   2. H(z) of (22) to that E by output error   3. E = H W   4. Fn by (24).
/// It converges linearly, at the squared largest canonical correlation of its two blocks: about
/// 0.974 an iteration for steady motion, faster where rests let the joint cool. not_converged,
/// with the numbers reached so far, where the observed rate says that a parameter would still move
/// by more than the option `tolerance`.
/// It gives no intervals: W is formed of the noisy torque, so the residual understates the errors
/// (on Table I such intervals would hold the time constant in 72 % of the runs instead of 95 %).
Identifier EnergyAls();

}  // namespace warmjoint::inline identification
