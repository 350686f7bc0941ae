#include "tools/figures/run/run_figures.h"

#include <fmt/core.h>

#include <cmath>

#include "tools/figures/symbols.h"

namespace warmjoint::figures {

const std::vector<RunFigure>& RunFigures() {
  static const std::vector<RunFigure> figures{
      {"npe_boxes", "parameter error of each identifier, beside the Cramér-Rao bound", &NpeBoxes,
       "answers with parameters"},
      {"ladder", "parameter error against what the suite's ladder climbs", &LadderFigure,
       "a suite with a ladder"},
      {"error_by_iteration", "parameter error and fit by iteration", &ErrorTraces,
       "an identifier that iterates"},
      {"parameters_by_iteration", "parameters of all realizations by iteration", &ParameterTraces,
       "an identifier that iterates"},
      {"agreement", "Fit, FPE, RMSE and MAE of each identifier", &AgreementBars, "answers"},
      {"coverage", "how often 95 % intervals hold the truth", &IntervalCoverage,
       "answers with intervals"},
      {"parameter_pairs", "errors of pairs of parameters with their ellipses", &ParameterPairs,
       "an identifier whose errors are near the bound"},
  };
  return figures;
}

std::vector<Rung> RungsOf(const RunView& run) {
  const Eigen::Index count = run.rungs.values.size();
  if (count < 2) return {std::nullopt};
  std::vector<Rung> rungs;
  for (Eigen::Index i = 0; i < count; ++i) rungs.emplace_back(i);
  return rungs;
}

std::string RungName(const RunView& run, const Rung& rung) {
  if (!rung) return "";
  const Rungs& rungs = run.rungs;
  if (!rungs.names.empty()) return rungs.names[static_cast<std::size_t>(*rung)];
  return fmt::format("{} {:g} {}", rungs.variable, rungs.values[*rung], UnitText(rungs.unit));
}

Eigen::VectorXd At(const RunRow& row, const Eigen::VectorXd& values, const Rung& rung) {
  if (!rung) return values;
  return (row.variant.array() == static_cast<int>(*rung)).select(values, std::nan(""));
}

std::string RunSubtitle(const RunView& run, const std::string& more) {
  const std::size_t rungs = RungsOf(run).size();
  return fmt::format(
      "{}: {} realization{}{}{}; {}", run.suite, run.realizations, run.realizations == 1 ? "" : "s",
      rungs > 1 ? fmt::format(" of all {} variants together", rungs) : "",
      run.drawn_every > 1 ? fmt::format(", one in {} drawn", run.drawn_every) : "", more);
}

std::string RungsSubtitle(const RunView& run, const std::string& more) {
  const auto rungs = static_cast<int>(RungsOf(run).size());
  if (rungs == 1) return RunSubtitle(run, more);
  return fmt::format("{}: {} realizations of each variant; {}", run.suite, run.realizations / rungs,
                     more);
}

}  // namespace warmjoint::figures
