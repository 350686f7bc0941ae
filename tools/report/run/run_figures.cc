#include "tools/report/run/run_figures.h"

#include <fmt/core.h>

namespace warmjoint::report {

const std::vector<RunFigure>& RunFigures() {
  static const std::vector<RunFigure> figures{
      {"npe_boxes", "parameter error of each identifier, beside the Cramér-Rao bound", &NpeBoxes,
       "answers with parameters"},
      {"ladder", "parameter error against what the suite's ladder climbs", &LadderFigure,
       "a suite with a ladder"},
      {"error_by_iteration", "parameter error and fit by iteration", &ErrorCourses,
       "an identifier that iterates"},
      {"parameters_by_iteration", "parameters of all realizations by iteration", &ParameterCourses,
       "an identifier that iterates"},
      {"agreement", "Fit, FPE, RMSE and MAE of each identifier", &AgreementBars, "answers"},
      {"coverage", "how often 95 % intervals hold the truth", &IntervalCoverage,
       "answers with intervals"},
      {"parameter_pairs", "errors of pairs of parameters with their ellipses", &ParameterPairs,
       "an identifier whose errors are near the bound"},
  };
  return figures;
}

std::string RunSubtitle(const RunView& run, const std::string& more) {
  const bool climbs = run.rungs.values.size() > 1;
  return fmt::format(
      "{}: {} realization{}{}{}; {}", run.suite, run.realizations, run.realizations == 1 ? "" : "s",
      climbs ? fmt::format(" of all {} variants together", run.rungs.values.size()) : "",
      run.drawn_every > 1 ? fmt::format(", one in {} drawn", run.drawn_every) : "", more);
}

}  // namespace warmjoint::report
