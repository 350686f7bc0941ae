// The legend stands above the plot, where it cannot hide data.
#include <algorithm>

#include "tools/report/draw/draw_plot.h"

namespace warmjoint::report {
namespace {

constexpr Type kType{size::kTick};

/// The sample in front of a legend's words.
class Key {
 public:
  Key(Canvas& canvas, Rgb colour, Point left_middle)
      : canvas_(canvas), colour_(colour), at_(left_middle) {}

  void operator()(const Line& line) { Stroke(line.width, line.dash); }
  void operator()(const LevelLine& level) { Stroke(level.width, level.dash); }
  void operator()(const Scatter& scatter) {
    canvas_.Stamp({{at_.x + size::kLegendKey / 2, at_.y}}, scatter.marker,
                  std::max(2.5, scatter.size), colour_);
  }
  void operator()(const Band& band) { Patch(band.opacity); }
  void operator()(const Bars& bars) { Patch(bars.opacity); }
  void operator()(const Box&) { Patch(0.6); }
  void operator()(const HeatMap&) {}
  void operator()(const Note&) {}

 private:
  void Stroke(double width, Dash dash) {
    canvas_.Stroke({{at_, {at_.x + size::kLegendKey, at_.y}}}, colour_, width, dash);
  }
  void Patch(double opacity) {
    canvas_.Fill(Rectangle{at_.x + 3, at_.y - 4, at_.x + size::kLegendKey - 3, at_.y + 4}, colour_,
                 opacity);
  }

  Canvas& canvas_;
  Rgb colour_;
  Point at_;
};

/// Calls put(series, x, y) for each entry, from (0, 0), in lines; returns the height.
template <typename Put>
double Arrange(const Plot& plot, double width, const Put& put) {
  double x = 0, y = 0, line = 0;
  for (const Series& series : plot.series) {
    if (series.label.empty()) continue;
    // each entry is a key with its words
    const Extent words = Measure(series.label, kType);
    const double entry = size::kLegendKey + size::kPad + words.width;
    line = words.height + 3;
    // entries that do not fit begin a new line
    if (x > 0 && x + entry > width) {
      x = 0;
      y += line;
    }
    put(series, x, y);
    x += entry + 16;
  }
  return line > 0 ? y + line : 0;
}

}  // namespace

double LegendHeight(const Plot& plot, double width) {
  return Arrange(plot, width, [](const Series&, double, double) {});
}

void DrawLegend(Pen& pen, const Plot& plot, Point at, double width) {
  Arrange(plot, width, [&](const Series& series, double x, double y) {
    const Rgb colour = pen.theme().Colour(series.hue);
    const double middle = at.y + y + size::kTick * 0.58;
    std::visit(Key(pen.canvas(), colour, {at.x + x, middle}), series.shape);
    pen.Write(series.label, kType, {at.x + x + size::kLegendKey + size::kPad, at.y + y},
              pen.theme().text);
  });
}

}  // namespace warmjoint::report
