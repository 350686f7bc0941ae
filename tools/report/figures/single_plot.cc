#include "tools/report/figures/single_plot.h"

namespace warmjoint::report {

Figure SinglePlot(const Caption& caption, const Plot& plot, int width, int height) {
  Figure figure;
  figure.name = caption.name;
  figure.title = caption.title;
  figure.subtitle = caption.subtitle;
  figure.finding = caption.finding;
  figure.width = width;
  figure.height = height;
  figure.panels.push_back({"", plot});
  return figure;
}

}  // namespace warmjoint::report
