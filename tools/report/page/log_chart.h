// A recording to zoom into, for pages.
#pragma once

#include <string>
#include <string_view>

#include "tools/report/figures/fit_view.h"

namespace warmjoint::report {

/// HTML of position, velocity and torque over time with the fit and what is kept: the charts' places and
/// their numbers. Long recordings are thinned: of each of 2500 parts, the first, lowest, highest and last
/// sample of each column stay.
std::string MakeLogChart(const FitView& view);

/// The script that draws it; the page's policy names its hash.
std::string_view LogChartScript();
/// The colours and sizes of the charts.
std::string_view LogChartStyle();

}  // namespace warmjoint::report
