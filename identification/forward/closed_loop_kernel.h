// The inner loop of closed_loop.h, with a function that is called for each sample.
#pragma once

#include <array>
#include <type_traits>
#include <utility>
#include <vector>

#include "identification/forward/closed_loop.h"

namespace warmjoint {

/// Eq. (22) over one interval where the loss follows E itself, W = |v| (g p + E): ThermalStep of the
/// level g p alone, with the gain ke |v| and the pole te + ke |v|. One product and one sum lead from
/// each E to its next, so that the chain of dependent operations is short.
/// speed: |v|, rad/s or m/s.
inline DiscreteThermal FedBack(const IntervalHold& hold, double speed) {
  const double gain = hold.gain * speed;
  return {gain, hold.pole + gain};
}

/// Number of law parameters: known at compile time (D), or only at run time, d, where D is Eigen::Dynamic.
template <int D>
constexpr Eigen::Index LoopSize(Eigen::Index d) {
  return D == Eigen::Dynamic ? d : D;
}

/// Derivatives of E by (p, k, log tau, E0, jumps), 0 at first. Plain numbers where D is known, so
/// that they stay in registers.
template <int D>
using Sensitivities = std::conditional_t<D == Eigen::Dynamic, std::vector<double>,
                                         std::array<double, static_cast<size_t>(D + 3)>>;

/// Samples of a loop with their levels: all of it, or a stretch.
struct LoopStretch {
  Eigen::Index first = 0, last = 0;  // samples, the last one past the end
  const double* levels = nullptr;    // [last - first x d] g, row by row
  const double* of_loss = nullptr;   // the same of the losses
  Eigen::Index d = 0;
};

/// Runs the loop along a stretch with its derivatives. parameters: [d] of the law; energy_at, slopes_at: E and its
/// derivatives [d + 3 + J] by (p, k, log tau, E0, jumps) at the first sample, led on to the one after the last; jumps: [J] of E
/// at the loop's jumps, for a D that is Dynamic alone; visit(n, a, g, S) gets the level a, its direct derivatives g [d] and
/// S, all at sample n: da/dp = g + S.
template <int D, typename Hold, typename Visit>
void RunAlong(const ClosedLoop& loop, const LoopStretch& stretch, const double* parameters,
              double gain, const double* jumps, const Hold& hold_after, double& energy_at,
              Sensitivities<D>& slopes_at, Visit&& visit) {
  // locals, which may stay in registers
  Sensitivities<D> S = std::move(slopes_at);
  double energy = energy_at;
  const Eigen::Index d = LoopSize<D>(stretch.d);
  const std::vector<Eigen::Index>& jump_at = loop.jumps();
  const double* g = stretch.levels;
  const double* of_loss = stretch.of_loss;
  const bool apart = of_loss != g;
  const double* speed = loop.speed().data();

  size_t jumped = 0;
  while (jumped < jump_at.size() && jump_at[jumped] < stretch.first) ++jumped;
  for (Eigen::Index n = stretch.first; n < stretch.last; ++n, g += d, of_loss += d) {
    if constexpr (D == Eigen::Dynamic) {
      if (jumped < jump_at.size() && jump_at[jumped] == n) {
        energy += jumps[jumped];
        S[static_cast<size_t>(d) + 3 + jumped++] = 1;
      }
    }
    double nominal = g[0] * parameters[0];
    for (Eigen::Index i = 1; i < d; ++i) nominal += g[i] * parameters[i];
    const double level = nominal + energy;
    visit(n, level, g, S.data());

    const IntervalHold& hold = hold_after(n);
    const auto [feedback, lambda] = FedBack(hold, speed[n]);
    if (apart) {
      nominal = of_loss[0] * parameters[0];
      for (Eigen::Index i = 1; i < d; ++i) nominal += of_loss[i] * parameters[i];
    }
    const double loss = speed[n] * (nominal + energy);
    for (Eigen::Index i = 0; i < d; ++i) S[i] = ThermalStep(feedback, lambda, S[i], of_loss[i]);
    S[d] = ThermalStep(hold.cooling, lambda, S[d], loss);
    S[d + 1] = ThermalStep(hold.pole_slope, lambda, S[d + 1], energy - gain * loss);
    S[d + 2] = lambda * S[d + 2];
    if constexpr (D == Eigen::Dynamic) {
      for (size_t i = 0; i < jumped; ++i) S[static_cast<size_t>(d) + 3 + i] *= lambda;
    }
    energy = ThermalStep(feedback, lambda, energy, nominal);
  }
  energy_at = energy;
  slopes_at = std::move(S);
}

/// RunAlong all of the loop, from E(0).
template <int D, typename Hold, typename Visit>
void RunWithSensitivities(const ClosedLoop& loop, const double* parameters, double gain,
                          double initial_energy, const double* jumps, const Hold& hold_after,
                          Visit&& visit) {
  const Eigen::Index d = LoopSize<D>(loop.levels().cols());
  Sensitivities<D> slopes{};
  if constexpr (D == Eigen::Dynamic)
    slopes.resize(static_cast<size_t>(d) + 3 + loop.jumps().size());
  slopes[d + 2] = 1;
  double energy = initial_energy;
  const LoopStretch all{0, loop.size(), loop.levels().data(), loop.loss_levels().data(), d};
  RunAlong<D>(loop, all, parameters, gain, jumps, hold_after, energy, slopes, visit);
}

/// Calls run(hold_after) with the hold that follows each sample n, hold_after(n): one for all, or one of a table.
template <typename Run>
void WithHolds(const Intervals& intervals, const Thermal& thermal, Run&& run) {
  const std::vector<IntervalHold> holds = Holds(intervals, thermal);
  if (intervals.even()) {
    run([hold = holds[0]](Eigen::Index) -> const IntervalHold& { return hold; });
  } else {
    run([&](Eigen::Index n) -> const IntervalHold& { return holds[intervals.which[n]]; });
  }
}

}  // namespace warmjoint
