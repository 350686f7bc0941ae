#include "tools/report/figures/single_plot.h"

namespace warmjoint::report {

Figure SinglePlot(const Caption& caption, const Plot& plot) {
  Figure figure;
  figure.name = caption.name;
  figure.title = caption.title;
  figure.subtitle = caption.subtitle;
  figure.finding = caption.finding;
  figure.height = 440;
  figure.panels.push_back({"", plot});
  return figure;
}

}  // namespace warmjoint::report
