// The family of pictures that a run gives, and its one list.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/report/draw/figure.h"
#include "tools/report/run/run_view.h"

namespace warmjoint::report {

/// One picture of a run; nothing where the run has no data for it.
struct RunFigure {
  std::string name;     // of the file
  std::string summary;  // what it shows, one line
  std::optional<Figure> (*make)(const RunView& run);
};

/// All pictures, the one that answers first first: a new one is its own file and one line in
/// run_figures.cc.
const std::vector<RunFigure>& RunFigures();

std::optional<Figure> NpeBoxes(const RunView& run);
std::optional<Figure> LadderFigure(const RunView& run);
std::optional<Figure> ErrorCourses(const RunView& run);
std::optional<Figure> ParameterCourses(const RunView& run);
std::optional<Figure> AgreementBars(const RunView& run);
std::optional<Figure> IntervalCoverage(const RunView& run);
std::optional<Figure> ParameterPairs(const RunView& run);

/// Symbol of a parameter, as set in print: "τ" for thermal_time_constant.
std::string SymbolOf(const std::string& parameter);

/// "table1: 50 realizations" and what else is worth a word.
std::string RunSubtitle(const RunView& run, const std::string& more);

}  // namespace warmjoint::report
