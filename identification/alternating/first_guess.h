// First guess of the thermal parameters from the envelope of the torque, Eq. (25).
#pragma once

#include <warmjoint/friction.h>
#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <optional>
#include <string>

namespace warmjoint {

/// The level of friction, c(t) = sign(v) tau - kv |v|, averaged over windows of time, and the figures that are
/// read off it. M windows, up to the first long rest.
struct TorqueEnvelope {
  Eigen::VectorXd time;   // [M] s from the first sample, middles of the windows
  Eigen::VectorXd level;  // [M] N.m or N
  double cold = 0;        // level at the start, N.m or N
  double settled = 0;     // mean level of the last quarter, N.m or N
  double time_to_63 = 0;  // s from the start, to 63 % of the way from cold to settled
};

struct FirstGuess {
  std::optional<Thermal> thermal;
  std::string why;  // why there is no guess: one sentence
  /// where there is a guess: the envelope that it was read off
  std::optional<TorqueEnvelope> envelope{};
};

/// Reads gain and time constant off a recording in which the joint starts cold, moves without long rests and
/// settles. With the friction level c(t) = sign(v) tau - kv |v| averaged over windows:
///   k = (c(settled) - c(0)) / mean(W)          W = |tau v|, over the settled part
///   tau = t63 (1 - k mean|v|)                  t63: when 63 % of the change is reached
/// The paper's (25) takes tau = t63; but losses fall as friction does, so that warming is faster
/// than the filter by 1 - k |v| (with E in |F v|, Eqs. (19)-(21), at a constant speed).
/// Refused with a sentence where the level does not change, or has not settled in the last quarter.
FirstGuess GuessThermal(const LogSamples& measurements, const Selection& selection);

}  // namespace warmjoint
