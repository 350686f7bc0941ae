#include "tools/report/draw/draw_series.h"

#include <implot.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "tools/report/draw/reduce.h"
#include "tools/report/draw/strokes.h"

namespace warmjoint::report {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr std::size_t kCrowd = 50000;  // markers
constexpr double kSpeck = 1.2;         // radius, points

/// Values as the axis spaces them: logarithms where it is logarithmic, NaN where there is none.
VectorXd OnAxis(const VectorXd& values, const Axis& axis) {
  if (axis.scale == Scale::linear) return values;
  return values.unaryExpr([](double v) { return v > 0 ? std::log10(v) : NAN; });
}

PixelSpan SpanOf(const Axis& axis, float points) {
  const int count = std::max(1, static_cast<int>(points * Canvas::kPixelsPerPoint));
  if (axis.scale == Scale::linear) return {axis.lower, axis.upper, count};
  return {std::log10(axis.lower), std::log10(axis.upper), count};
}

/// Draws one series; one function for each shape.
class Draughtsman {
 public:
  Draughtsman(Pen& pen, const Plot& plot, const Series& series, const Rectangle& area)
      : pen_(pen), plot_(plot), area_(area), list_(*ImPlot::GetPlotDrawList()) {
    drawn_.label = series.label;
    drawn_.colour = pen.theme().Colour(series.hue);
    drawn_.x = drawn_.y = {INFINITY, -INFINITY};
    paint_ = Pen::Paint(drawn_.colour);
  }

  DrawnSeries Result() const { return drawn_; }

  void operator()(const Line& line) {
    const auto chosen = ReduceCurve(OnAxis(line.x, plot_.x), OnAxis(line.y, plot_.y), AcrossSpan());
    std::vector<ImVec2> path;
    for (Index i : chosen) {
      // a gap, or what a logarithmic axis cannot show, ends the stroke
      if (!Shown(line.x[i], line.y[i])) {
        StrokePath(list_, path, paint_, static_cast<float>(line.width), line.dash);
        path.clear();
        continue;
      }
      path.push_back(Put(line.x[i], line.y[i]));
    }
    StrokePath(list_, path, paint_, static_cast<float>(line.width), line.dash);
  }

  void operator()(const Scatter& scatter) {
    const auto chosen =
        ReduceScatter(OnAxis(scatter.x, plot_.x), OnAxis(scatter.y, plot_.y), AcrossSpan(),
                      SpanOf(plot_.y, area_.height()), scatter.size * Canvas::kPixelsPerPoint);
    const ImU32 paint = Pen::Paint(drawn_.colour, scatter.opacity);
    // in a crowd of specks nobody sees a shape, and squares draw three times as fast
    const bool crowd = chosen.size() > kCrowd && scatter.size <= kSpeck;
    const Marker marker = crowd ? Marker::square : scatter.marker;
    for (Index i : chosen) {
      StampMarker(list_, Put(scatter.x[i], scatter.y[i]), marker, static_cast<float>(scatter.size),
                  paint);
    }
  }

  void operator()(const Band& band) {
    // keep what either edge needs
    auto chosen = ReduceCurve(OnAxis(band.x, plot_.x), OnAxis(band.lower, plot_.y), AcrossSpan());
    const auto more =
        ReduceCurve(OnAxis(band.x, plot_.x), OnAxis(band.upper, plot_.y), AcrossSpan());
    std::vector<Index> both;
    std::set_union(chosen.begin(), chosen.end(), more.begin(), more.end(),
                   std::back_inserter(both));
    std::vector<double> x, lower, upper;
    ImPlotSpec spec;
    spec.FillColor = ImGui::ColorConvertU32ToFloat4(Pen::Paint(drawn_.colour, band.opacity));
    spec.LineWeight = 0;
    const auto fill = [&] {
      if (x.size() > 1) {
        ImPlot::PlotShaded("##band", x.data(), lower.data(), upper.data(),
                           static_cast<int>(x.size()), spec);
      }
      for (auto* part : {&x, &lower, &upper}) part->clear();
    };
    for (Index i : both) {
      // a gap ends the area, as it ends a line
      if (!Shown(band.x[i], band.lower[i]) || !Shown(band.x[i], band.upper[i])) {
        fill();
        continue;
      }
      Put(band.x[i], band.lower[i]);
      Put(band.x[i], band.upper[i]);
      x.push_back(band.x[i]);
      lower.push_back(band.lower[i]);
      upper.push_back(band.upper[i]);
    }
    fill();
  }

  void operator()(const Bars& bars) {
    const double base =
        plot_.y.scale == Scale::linear ? std::max(0.0, plot_.y.lower) : plot_.y.lower;
    for (Index i = 0; i < bars.x.size(); ++i) {
      if (!std::isfinite(bars.height[i])) continue;
      const ImVec2 corner = Put(bars.x[i] - bars.width / 2, bars.height[i]);
      const ImVec2 foot = Put(bars.x[i] + bars.width / 2, base);
      list_.AddRectFilled({corner.x, std::min(corner.y, foot.y)},
                          {foot.x, std::max(corner.y, foot.y)}, paint_);
    }
  }

  void operator()(const Box& box) {
    const double half = box.width / 2;
    const ImVec2 low = Put(box.x, box.lower), high = Put(box.x, box.upper);
    const ImVec2 corner = Put(box.x - half, box.q75), foot = Put(box.x + half, box.q25);
    const ImVec2 middle = Put(box.x, box.median);
    const float cap = 0.25f * (foot.x - corner.x);
    for (const auto& [from, to] : {std::pair(low, foot), std::pair(high, corner)}) {
      StrokeLine(list_, from, {from.x, to.y}, paint_, 1.3f);
      StrokeLine(list_, {from.x - cap, from.y}, {from.x + cap, from.y}, paint_, 1.3f);
    }
    list_.AddRectFilled(corner, foot, Pen::Paint(drawn_.colour, 0.25));
    const ImVec2 outline[] = {corner, {foot.x, corner.y}, foot, {corner.x, foot.y}};
    list_.AddPolyline(outline, 4, paint_, ImDrawFlags_Closed, 1.3f);
    StrokeLine(list_, {corner.x, middle.y}, {foot.x, middle.y}, paint_, 2.5f);
    for (double value : box.outliers)
      StampMarker(list_, Put(box.x, value), Marker::circle, 1.8f, paint_);
  }

  void operator()(const HeatMap& map) {
    const double across = (map.x.second - map.x.first) / static_cast<double>(map.values.cols());
    const double up = (map.y.second - map.y.first) / static_cast<double>(map.values.rows());
    for (Index row = 0; row < map.values.rows(); ++row) {
      for (Index column = 0; column < map.values.cols(); ++column) {
        const double value = map.values(row, column);
        if (!std::isfinite(value)) continue;
        const double x = map.x.first + across * static_cast<double>(column);
        const double y = map.y.first + up * static_cast<double>(row);
        const ImVec2 corner = Put(x, y + up), foot = Put(x + across, y);
        const double fraction =
            (value - map.colours.first) / (map.colours.second - map.colours.first);
        list_.AddRectFilled(corner, foot, Pen::Paint(HeatColour(fraction)));
      }
    }
  }

  void operator()(const LevelLine& level) {
    std::vector<ImVec2> path;
    if (level.vertical) {
      path = {Put(level.value, plot_.y.lower), Put(level.value, plot_.y.upper)};
    } else {
      path = {Put(plot_.x.lower, level.value), Put(plot_.x.upper, level.value)};
    }
    StrokePath(list_, path, paint_, static_cast<float>(level.width), level.dash);
  }

  void operator()(const Note& note) {
    const Type type{size::kTick};
    const ImVec2 extent = pen_.Measure(note.text, type);
    const ImVec2 at = Put(note.x, note.y);
    const float shift = note.side == Side::left ? 0 : note.side == Side::centre ? 0.5f : 1;
    pen_.Write(list_, note.text, type, {at.x - shift * extent.x, at.y - extent.y / 2},
               drawn_.colour);
  }

 private:
  bool Shown(double x, double y) const {
    return std::isfinite(x) && std::isfinite(y) && (plot_.x.scale == Scale::linear || x > 0) &&
           (plot_.y.scale == Scale::linear || y > 0);
  }

  PixelSpan AcrossSpan() const { return SpanOf(plot_.x, area_.width()); }

  /// The place of a data point on the page; remembered in the result.
  ImVec2 Put(double x, double y) {
    ++drawn_.points;
    drawn_.x = {std::min(drawn_.x.first, x), std::max(drawn_.x.second, x)};
    drawn_.y = {std::min(drawn_.y.first, y), std::max(drawn_.y.second, y)};
    return ImPlot::PlotToPixels(x, y);
  }

  Pen& pen_;
  const Plot& plot_;
  const Rectangle& area_;
  ImDrawList& list_;
  ImU32 paint_ = 0;
  DrawnSeries drawn_;
};

}  // namespace

DrawnSeries DrawSeries(Pen& pen, const Plot& plot, const Series& series, const Rectangle& area) {
  Draughtsman draughtsman(pen, plot, series, area);
  ImPlot::PushPlotClipRect();
  std::visit(draughtsman, series.shape);
  ImPlot::PopPlotClipRect();
  return draughtsman.Result();
}

Rgb HeatColour(double fraction) {
  // viridis at each tenth
  static constexpr Rgb kTenths[] = {{68, 1, 84},    {72, 36, 117},  {65, 68, 135},  {53, 95, 141},
                                    {42, 120, 142}, {33, 145, 140}, {34, 168, 132}, {68, 191, 112},
                                    {122, 209, 81}, {189, 223, 38}, {253, 231, 37}};
  constexpr int kSteps = static_cast<int>(std::size(kTenths)) - 1;
  const double place = kSteps * std::clamp(fraction, 0.0, 1.0);
  const int lower = std::min(kSteps - 1, static_cast<int>(place));
  const auto mix = [&](std::uint8_t Rgb::*channel) {
    const double share = place - lower;
    const double value =
        (1 - share) * (kTenths[lower].*channel) + share * (kTenths[lower + 1].*channel);
    return static_cast<std::uint8_t>(value + 0.5);
  };
  return {mix(&Rgb::red), mix(&Rgb::green), mix(&Rgb::blue)};
}

}  // namespace warmjoint::report
