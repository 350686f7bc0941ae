#include "identification/warming/gaps.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>

#include "identification/fit/fit_parameters.h"
#include "identification/warming/initial_energy.h"
#include "models/friction/thermal.h"
#include "models/recording/measurements.h"

namespace warmjoint {
namespace {

constexpr size_t kMostGaps = 50;

bool RestsOver(const LogSamples& m, Eigen::Index behind) {
  return m.velocity[behind - 1] == 0 && m.velocity[behind] == 0 &&
         m.position[behind - 1] == m.position[behind];
}

/// Fits once more from where a fit ended, with what is known of E(0) and the noise that the fit left.
ThermalFit Again(ThermalRows rows, const InitialEnergy& initial, const ThermalFit& fit) {
  rows.initial = initial;
  rows.scale = rows.ScaleOf(fit);
  ThermalFit next = FitThermalFriction(rows, StartFrom(fit));
  next.Follow(fit);
  return next;
}

/// The largest |E| along the log of a fit. N.m or N
double WarmestOf(const LawBlocks& blocks, const ThermalFit& fit) {
  return blocks.loop->Simulate(fit.law(), fit.thermal(), fit.initial_energy(), fit.JumpsOfE())
      .energy.cwiseAbs()
      .maxCoeff();
}

/// FitJumps with the E(0) that the fit estimates or holds. rows: with the jumps
Eigen::VectorXd AddJumps(ThermalRows rows, const std::vector<LogGap>& gaps, ThermalFit& fit) {
  // how large jumps may be, by the energy without them
  rows.jump_spread = JumpSpread(gaps, WarmestOf(rows.blocks, fit), fit.thermal().time_constant);
  fit = Again(rows, fit.initial, fit);
  return rows.jump_spread;
}

}  // namespace

std::vector<LogGap> FindGaps(const LogSamples& measurements) {
  const LogSamples& m = measurements;
  std::vector<LogGap> gaps = m.gaps ? *m.gaps : GapsOf(m.time);
  // a joint at rest loses nothing, and a new recording is no gap
  std::erase_if(gaps, [&](const LogGap& gap) {
    return RestsOver(m, gap.behind) || std::ranges::binary_search(m.further_starts, gap.behind);
  });
  if (gaps.size() <= kMostGaps) return gaps;
  // the longest of them, in order of time
  std::ranges::nth_element(gaps, gaps.begin() + kMostGaps, std::greater(), &LogGap::length);
  gaps.resize(kMostGaps);
  std::ranges::sort(gaps, {}, &LogGap::behind);
  return gaps;
}

std::vector<LogGap> FurtherStarts(const LogSamples& measurements) {
  std::vector<LogGap> starts;
  for (const Eigen::Index start : measurements.further_starts) {
    starts.push_back({start, kInfinity});
  }
  return starts;
}

std::vector<LogGap> FreeStarts(const InitialEnergy& initial, const LogSamples& measurements,
                               const Selection& kept) {
  if (!initial.is_open()) return {};
  std::vector<LogGap> free = FurtherStarts(measurements);
  for (const SampleRange& one : measurements.Recordings()) {
    if (kept.keep.segment(one.first, one.count).any()) continue;
    std::erase_if(free, [&](const LogGap& start) { return start.behind == one.first; });
  }
  return free;
}

std::vector<LogGap> Merged(const std::vector<LogGap>& one, const std::vector<LogGap>& other) {
  std::vector<LogGap> both;
  std::ranges::merge(one, other, std::back_inserter(both), {}, &LogGap::behind, &LogGap::behind);
  return both;
}

Eigen::VectorXd JumpSpread(const std::vector<LogGap>& gaps, double warmest, double time_constant) {
  Eigen::VectorXd spread(static_cast<Eigen::Index>(gaps.size()));
  for (size_t i = 0; i < gaps.size(); ++i) {
    spread[static_cast<Eigen::Index>(i)] =
        IsStart(gaps[i]) ? kInfinity : warmest * HoldOver(gaps[i].length, time_constant).cooling;
  }
  return spread;
}

std::vector<std::string> JumpNames(const std::vector<LogGap>& gaps,
                                   const LogSamples& measurements) {
  std::vector<std::string> names;
  int gap = 0;
  for (const LogGap& at : gaps) {
    const auto recording = std::ranges::upper_bound(measurements.further_starts, at.behind) -
                           measurements.further_starts.begin();
    names.push_back(IsStart(at) ? NameOf(Role::start, static_cast<int>(recording))
                                : NameOf(Role::jump, gap++));
  }
  return names;
}

std::vector<Eigen::Index> Behind(const std::vector<LogGap>& gaps) {
  std::vector<Eigen::Index> behind;
  for (const LogGap& gap : gaps) behind.push_back(gap.behind);
  return behind;
}

Eigen::VectorXd FitJumps(const ThermalRows& rows, const std::vector<LogGap>& gaps,
                         const InitialGuess& scanned, ThermalFit& fit) {
  ThermalRows with = rows;
  with.jump_samples = Behind(gaps);
  Eigen::VectorXd spread = AddJumps(with, gaps, fit);
  if (!fit.estimates_initial_energy()) return spread;

  // the other order: a cold start, jumps, then E(0)
  ThermalRows cold = rows;
  cold.initial = InitialEnergy::zero;
  cold.scale = rows.ScaleOf(fit);
  ThermalFit other = FitThermalFriction(cold, scanned);
  if (!other.converged) return spread;
  with.jump_spread = AddJumps(with, gaps, other);
  ThermalFit freed = Again(with, fit.initial, other);
  // taken where it converges and leaves smaller squares
  const bool leaves_less = !(fit.converged && fit.squares <= freed.squares);
  if (!freed.converged || !leaves_less) return spread;
  fit = std::move(freed);
  return with.jump_spread;
}

std::string RefitStart(const ThermalRows& rows,
                       const std::function<double(const ThermalFit&)>& deviation, ThermalFit& fit) {
  const InitialEnergy initial = fit.initial;
  if (!initial.is_expected()) return "";

  // the fit to the log alone, which also determines its noise
  const ThermalFit alone = Again(rows, InitialEnergy::estimated, fit);
  if (alone.converged) {
    const std::string unlike =
        ContradictsExpected(initial, alone.initial_energy(), deviation(alone));
    if (!unlike.empty()) {
      fit = alone;
      return unlike;
    }
  }
  // no contradiction: both together, from where the better fit ended
  const ThermalFit& better = alone.converged ? alone : fit;
  fit = Again(rows, initial, better);
  return "";
}

}  // namespace warmjoint
