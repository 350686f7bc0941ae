// What a picture shows, as read back from its drawing: for checks.
#pragma once

#include <string>
#include <vector>

#include "tools/report/draw/figure.h"
#include "tools/report/draw/place.h"
#include "tools/report/gl/image.h"

namespace warmjoint::report {

struct DrawnText {
  std::string text;
  Rectangle place;
};

/// A series as handed to the renderer, inside the limits or not.
struct DrawnSeries {
  std::string label;
  Rgb colour;
  Eigen::Index samples = 0;           // before reduction
  Eigen::Index points = 0;            // after it
  std::pair<double, double> x{0, 0};  // lowest and highest
  std::pair<double, double> y{0, 0};
};

struct DrawnPlot {
  std::string title;
  Rectangle area;                     // between the axes
  std::pair<double, double> x{0, 0};  // limits as the renderer had them
  std::pair<double, double> y{0, 0};
  std::vector<DrawnSeries> series;
};

struct Drawn {
  Image image;
  std::vector<DrawnPlot> plots;
  std::vector<DrawnText> texts;
  std::vector<std::string> unreadable;  // texts with characters that the typeface lacks
  std::vector<Rectangle> pictures;      // one for each panel that is a picture, in their order
};

}  // namespace warmjoint::report
