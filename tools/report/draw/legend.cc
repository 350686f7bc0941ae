// The legend stands above the plot, where it cannot hide data.
#include "tools/report/draw/draw_plot.h"
#include "tools/report/draw/strokes.h"

namespace warmjoint::report {
namespace {

constexpr Type kType{size::kTick};

/// The sample in front of a legend's words.
class Key {
 public:
  Key(ImDrawList& list, Rgb colour, ImVec2 left_middle)
      : list_(list), colour_(colour), paint_(Pen::Paint(colour)), at_(left_middle) {}

  void operator()(const Line& line) { Stroke(static_cast<float>(line.width), line.dash); }
  void operator()(const LevelLine& level) { Stroke(static_cast<float>(level.width), level.dash); }
  void operator()(const Scatter& scatter) {
    StampMarker(list_, {at_.x + size::kLegendKey / 2, at_.y}, scatter.marker,
                std::max(2.5f, static_cast<float>(scatter.size)), paint_);
  }
  void operator()(const Band& band) { Patch(band.opacity); }
  void operator()(const Bars&) { Patch(1); }
  void operator()(const Box&) { Patch(0.6); }
  void operator()(const HeatMap&) {}
  void operator()(const Note&) {}

 private:
  void Stroke(float width, Dash dash) {
    StrokePath(list_, {at_, {at_.x + size::kLegendKey, at_.y}}, paint_, width, dash);
  }
  void Patch(double opacity) {
    list_.AddRectFilled({at_.x + 3, at_.y - 4}, {at_.x + size::kLegendKey - 3, at_.y + 4},
                        Pen::Paint(colour_, opacity));
  }

  ImDrawList& list_;
  Rgb colour_;
  ImU32 paint_;
  ImVec2 at_;
};

/// Calls put(series, x, y) for each entry, from (0, 0), in lines; returns the height.
template <typename Put>
float Arrange(const Pen& pen, const Plot& plot, float width, const Put& put) {
  float x = 0, y = 0, line = 0;
  for (const Series& series : plot.series) {
    if (series.label.empty()) continue;
    const ImVec2 words = pen.Measure(series.label, kType);
    const float entry = size::kLegendKey + size::kPad + words.x;
    line = words.y + 3;
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

float LegendHeight(const Pen& pen, const Plot& plot, float width) {
  return Arrange(pen, plot, width, [](const Series&, float, float) {});
}

void DrawLegend(Pen& pen, const Plot& plot, ImVec2 at, float width) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  Arrange(pen, plot, width, [&](const Series& series, float x, float y) {
    const Rgb colour = pen.theme().Colour(series.hue);
    const float middle = at.y + y + size::kTick * 0.58f;
    std::visit(Key(list, colour, {at.x + x, middle}), series.shape);
    pen.Write(list, series.label, kType, {at.x + x + size::kLegendKey + size::kPad, at.y + y},
              pen.theme().text);
  });
}

}  // namespace warmjoint::report
