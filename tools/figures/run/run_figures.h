// The family of pictures that a run gives, and its one list.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/figures/figure.h"
#include "tools/figures/run/run_view.h"

namespace warmjoint::figures {

using RunFigure = NamedFigure<RunView>;

/// All pictures, the one that answers first first: a new one is its own file and one line in
/// run_figures.cc.
const std::vector<RunFigure>& RunFigures();

std::optional<Figure> NpeBoxes(const RunView& run);
std::optional<Figure> LadderFigure(const RunView& run);
std::optional<Figure> ErrorTraces(const RunView& run);
std::optional<Figure> ParameterTraces(const RunView& run);
std::optional<Figure> AgreementBars(const RunView& run);
std::optional<Figure> IntervalCoverage(const RunView& run);
std::optional<Figure> ParameterPairs(const RunView& run);

/// A variant of the suite, by its position in the ladder; none: all realizations.
using Rung = std::optional<Eigen::Index>;

/// The suite's rungs where it has several, one after the other; none alone where it has not: what is measured under
/// different noise is not put together.
std::vector<Rung> RungsOf(const RunView& run);

/// "noise.torque 0.1 N·m" or the variant's name; empty of none.
std::string RungName(const RunView& run, const Rung& rung);

/// The values of a row at a variant's realizations, NaN elsewhere. values: [R].
Eigen::VectorXd At(const RunRow& row, const Eigen::VectorXd& values, const Rung& rung);

/// "table1: 50 realizations" and what else is worth a word. Of a suite with a ladder: "of all its variants together".
std::string RunSubtitle(const RunView& run, const std::string& more);
/// The same of a figure that shows each variant by itself.
std::string RungsSubtitle(const RunView& run, const std::string& more);

}  // namespace warmjoint::figures
