#include "tools/report/run/run_figures.h"

#include <fmt/core.h>

namespace warmjoint::report {

const std::vector<RunFigure>& RunFigures() {
  static const std::vector<RunFigure> figures{
      {"npe_boxes", "parameter error of each identifier, beside the Cramér-Rao bound", &NpeBoxes},
      {"ladder", "parameter error against what the suite's ladder climbs", &LadderFigure},
      {"error_by_iteration", "parameter error and fit by iteration", &ErrorCourses},
      {"parameters_by_iteration", "parameters of all realizations by iteration", &ParameterCourses},
      {"agreement", "Fit, FPE, RMSE and MAE of each identifier", &AgreementBars},
      {"coverage", "how often 95 % intervals hold the truth", &IntervalCoverage},
      {"parameter_pairs", "errors of pairs of parameters with their ellipses", &ParameterPairs},
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
