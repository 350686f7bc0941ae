// Figures of one plot.
#pragma once

#include <string>

#include "tools/report/draw/figure.h"

namespace warmjoint::report {

/// What stands around a plot: see Figure.
struct Caption {
  std::string name;
  std::string title;
  std::string subtitle;
  std::string finding;
};

/// A figure of that one plot.
Figure SinglePlot(const Caption& caption, const Plot& plot);

}  // namespace warmjoint::report
