// The numbers behind a figure.
#pragma once

#include <string>

#include "tools/report/draw/figure.h"

namespace warmjoint::report {

/// All that the figure's plots show, before any thinning, as CSV: panel, series, kind, x, y, lower,
/// upper, value. kind: line, dot, band, bar, box (y: median; lower, upper: quartiles), whiskers,
/// outlier, cell (value: its colour), level (x or y). Lines that begin with # name the axes with their
/// units. Numbers have all their digits.
std::string FigureCsv(const Figure& figure);

}  // namespace warmjoint::report
