// A fit of law, gravity and heat on its way through its passes, and what it came to.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "identification/fit/fit.h"
#include "identification/inference/hausman_test.h"
#include "identification/lagged/lagged_rows.h"
#include "identification/warming/gaps.h"
#include "identification/warming/law_problem.h"
#include "identification/warming/thermal_fit.h"

namespace warmjoint {

/// The state of a fit from its first pass, by plain squares, to its last.
struct LawFit {
  std::string name;
  LawProblem problem;
  RowTreatment rows;
  ThermalFit fit;
  double nominal_squares = 0;    // that the law leaves without heat, on the same rows
  InitialGuess scanned{};        // where a fit with heat began
  double threshold = kInfinity;  // N.m or N, from which on Huber's loss is linear
  std::shared_ptr<const LaggedRows> lag{};
  std::shared_ptr<const Whitening> whitening{};
  std::optional<Disagreement> unwhitened{};  // why coloured rows were not whitened

  const IdentifierInput& input() const { return problem.input(); }
  const LogSamples& measurements() const { return problem.input().measurements; }
  /// Takes over a pass, and the squares that the law leaves on its rows without heat.
  void Take(RowTreatment treatment, ThermalFit next) {
    rows = std::move(treatment);
    fit = std::move(next);
    nominal_squares = fit.has_heat() ? problem.FitCold(rows).squares : fit.squares;
  }
};

/// The result of the last pass, or why it is refused.
Fit ConcludeLaw(LawFit law);

/// Rows of the table for the heat: gain, time constant, E(0) where it was estimated, jumps. gaps: of the jumps [J],
/// further starts among them
std::vector<Unknown> HeatTable(const ThermalFit& warm, const std::vector<LogGap>& gaps,
                               const LogSamples& measurements);

/// Notes with a fit what is uncertain about its heat: losses within gaps of the log, and how warm the joint was as further
/// recordings began where that of the first alone was expected.
void RemarkOnHeat(const ThermalFit& warm, const std::vector<LogGap>& gaps,
                  const LogSamples& measurements, Fit& fit);

}  // namespace warmjoint
