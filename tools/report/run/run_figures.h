// The family of pictures that a run gives, and its one list.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/report/draw/named_figure.h"
#include "tools/report/figures/symbols.h"
#include "tools/report/run/run_view.h"

namespace warmjoint::report {

using RunFigure = NamedFigure<RunView>;

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

/// "table1: 50 realizations" and what else is worth a word. Of a suite with a ladder: "of all its
/// variants together".
std::string RunSubtitle(const RunView& run, const std::string& more);

}  // namespace warmjoint::report
