#include "tools/report/draw/draw_series.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "tools/report/draw/reduce.h"

namespace warmjoint::report {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kCrowd = 2000;      // samples that are drawn one by one
constexpr double kTouching = 0.52;  // radius of a stroke, in distances between them

/// Values as the axis spaces them: logarithms where it is logarithmic, NaN where there is none.
VectorXd OnAxis(const VectorXd& values, const Axis& axis) {
  if (axis.scale == Scale::linear) return values;
  return values.unaryExpr([](double v) { return v > 0 ? std::log10(v) : NAN; });
}

CellSpan SpanOf(const Axis& axis, double points, double cell) {
  const int count = std::max(1, static_cast<int>(points / cell));
  if (axis.scale == Scale::linear) return {axis.lower, axis.upper, count};
  return {std::log10(axis.lower), std::log10(axis.upper), count};
}

/// Draws one series; one function for each shape.
class Draughtsman {
 public:
  Draughtsman(Pen& pen, const Plot& plot, const Series& series, const Frame& frame)
      : pen_(pen), plot_(plot), frame_(frame), canvas_(pen.canvas()) {
    drawn_.label = series.label;
    drawn_.colour = pen.theme().Colour(series.hue);
    drawn_.x = drawn_.y = {INFINITY, -INFINITY};
  }

  DrawnSeries Result() const { return drawn_; }

  void operator()(const Line& line) {
    drawn_.samples = line.x.size();
    std::vector<std::vector<Point>> paths(1);
    for (Index i : CurveOf(line.x, line.y)) {
      // a gap, or what a logarithmic axis cannot show, ends the stroke
      if (Shown(line.x[i], line.y[i])) {
        paths.back().push_back(Put(line.x[i], line.y[i]));
      } else if (!paths.back().empty()) {
        paths.emplace_back();
      }
    }
    canvas_.Stroke(paths, drawn_.colour, line.width, line.dash);
  }

  void operator()(const Scatter& scatter) {
    drawn_.samples = scatter.x.size();
    if (scatter.x.size() > kCrowd && scatter.marker == Marker::circle) return DrawCrowd(scatter);
    // a logarithmic axis has no place for samples at or below zero
    std::vector<Point> centres;
    for (Index i = 0; i < scatter.x.size(); ++i) {
      if (Shown(scatter.x[i], scatter.y[i])) centres.push_back(Put(scatter.x[i], scatter.y[i]));
    }
    canvas_.Stamp(centres, scatter.marker, scatter.size, drawn_.colour, scatter.opacity);
  }

  void operator()(const Band& band) {
    drawn_.samples = band.x.size();
    // keep what either edge needs
    const std::vector<Index> below = CurveOf(band.x, band.lower),
                             above = CurveOf(band.x, band.upper);
    std::vector<Index> both;
    std::set_union(below.begin(), below.end(), above.begin(), above.end(),
                   std::back_inserter(both));
    std::vector<Point> lower, upper;
    // closes the area between both edges
    const auto fill = [&] {
      lower.insert(lower.end(), upper.rbegin(), upper.rend());
      canvas_.Fill(lower, drawn_.colour, band.opacity);
      lower.clear();
      upper.clear();
    };
    for (Index i : both) {
      // a gap ends the area, as it ends a line
      if (Shown(band.x[i], band.lower[i]) && Shown(band.x[i], band.upper[i])) {
        lower.push_back(Put(band.x[i], band.lower[i]));
        upper.push_back(Put(band.x[i], band.upper[i]));
      } else {
        fill();
      }
    }
    fill();
  }

  void operator()(const Bars& bars) {
    drawn_.samples = bars.x.size();
    // bars stand on zero, or on the axis where that does not reach zero
    const double base =
        plot_.y.scale == Scale::linear ? std::max(0.0, plot_.y.lower) : plot_.y.lower;
    for (Index i = 0; i < bars.x.size(); ++i) {
      if (!std::isfinite(bars.height[i])) continue;
      const Point corner = Put(bars.x[i] - bars.width / 2, bars.height[i]);
      const Point foot = Put(bars.x[i] + bars.width / 2, base);
      canvas_.Fill(
          Rectangle{corner.x, std::min(corner.y, foot.y), foot.x, std::max(corner.y, foot.y)},
          drawn_.colour, bars.opacity);
    }
  }

  void operator()(const Box& box) {
    constexpr double kThin = 1.3, kThick = 2.5, kDot = 1.8;  // points
    // corners of the box, which reaches from quartile to quartile
    const double half = box.width / 2;
    const Point low = Put(box.x, box.lower), high = Put(box.x, box.upper);
    const Point corner = Put(box.x - half, box.q75), foot = Put(box.x + half, box.q25);
    const Point middle = Put(box.x, box.median);
    // whiskers, each with a cap at its end
    const double cap = 0.25 * (foot.x - corner.x);
    for (const auto& [from, to] : {std::pair(low, foot), std::pair(high, corner)}) {
      canvas_.Stroke(from, {from.x, to.y}, drawn_.colour, kThin);
      canvas_.Stroke({from.x - cap, from.y}, {from.x + cap, from.y}, drawn_.colour, kThin);
    }
    // the box, and a thick line at its median
    const Rectangle outline{corner.x, corner.y, foot.x, foot.y};
    canvas_.Fill(outline, drawn_.colour, 0.25);
    canvas_.Outline(outline, drawn_.colour, kThin);
    canvas_.Stroke({corner.x, middle.y}, {foot.x, middle.y}, drawn_.colour, kThick);
    // values beyond the whiskers as small dots
    std::vector<Point> outliers;
    for (double value : box.outliers) outliers.push_back(Put(box.x, value));
    canvas_.Stamp(outliers, Marker::circle, kDot, drawn_.colour);
  }

  void operator()(const HeatMap& map) {
    // the range that the picture shows is that of the whole map
    Put(map.x.first, map.y.first);
    Put(map.x.second, map.y.second);
    // where on the map a value falls; -1 outside
    const auto cell = [](double value, const std::pair<double, double>& range, Index count) {
      const double share = (value - range.first) / (range.second - range.first);
      return share >= 0 && share <= 1
                 ? std::min(count - 1, static_cast<Index>(share * static_cast<double>(count)))
                 : Index{-1};
    };
    // each place takes the colour of its cell; unknown cells stay empty
    canvas_.Paint(frame_.area(), [&](Point p) -> std::optional<Rgb> {
      const Index column = cell(frame_.ValueX(p), map.x, map.values.cols());
      const Index row = cell(frame_.ValueY(p), map.y, map.values.rows());
      if (column < 0 || row < 0 || !std::isfinite(map.values(row, column))) return std::nullopt;
      const double above = map.values(row, column) - map.colours.first;
      return HeatColour(above / (map.colours.second - map.colours.first));
    });
  }

  void operator()(const LevelLine& level) {
    // from edge to edge of the plot
    std::vector<Point> path;
    if (level.vertical) {
      path = {Put(level.value, plot_.y.lower), Put(level.value, plot_.y.upper)};
    } else {
      path = {Put(plot_.x.lower, level.value), Put(plot_.x.upper, level.value)};
    }
    canvas_.Stroke({path}, drawn_.colour, level.width, level.dash);
  }

  void operator()(const Note& note) {
    const Type type{size::kTick};
    const Extent extent = Measure(note.text, type);
    const Point at = Put(note.x, note.y);
    // which part of the words stands at the place: begin, middle or end
    const double shift = note.side == Side::left ? 0 : note.side == Side::centre ? 0.5 : 1;
    pen_.Write(note.text, type, {at.x - shift * extent.width, at.y - extent.height / 2},
               drawn_.colour);
  }

 private:
  /// So many samples that they are drawn as strokes of a pen as wide as their markers.
  void DrawCrowd(const Scatter& scatter) {
    const double cell = canvas_.cell();
    // markers so near leave notches between them that nobody sees: 6 % of their radius
    const double reach = std::max(1.0, 0.7 * scatter.size / cell);
    const Rectangle& area = frame_.area();
    const CellSpan columns = SpanOf(plot_.x, area.width(), cell);
    const CellSpan rows = SpanOf(plot_.y, area.height(), cell);
    const double width = area.width() / columns.count;
    const VectorXd x = OnAxis(scatter.x, plot_.x), y = OnAxis(scatter.y, plot_.y);
    // in each column samples that lie close together become one stroke
    std::vector<std::pair<Point, Point>> strokes;
    for (const auto& [from, to] : ReduceCloud(x, y, columns, rows, reach)) {
      Point begin = Put(scatter.x[from], scatter.y[from]);
      Point end = begin;
      if (to != from) {
        // strokes stand side by side in the middles of their columns
        end = Put(scatter.x[to], scatter.y[to]);
        begin.x = end.x = area.left + (std::floor((begin.x - area.left) / width) + 0.5) * width;
      }
      strokes.emplace_back(begin, end);
    }
    // neighbouring strokes touch
    const double radius = std::max(scatter.size, kTouching * cell);
    canvas_.Brush(strokes, radius, drawn_.colour, scatter.opacity);
  }

  std::vector<Index> CurveOf(const VectorXd& x, const VectorXd& y) const {
    return ReduceCurve(OnAxis(x, plot_.x), OnAxis(y, plot_.y),
                       SpanOf(plot_.x, frame_.area().width(), canvas_.cell()));
  }

  bool Shown(double x, double y) const {
    return std::isfinite(x) && std::isfinite(y) && (plot_.x.scale == Scale::linear || x > 0) &&
           (plot_.y.scale == Scale::linear || y > 0);
  }

  /// The place of a data point on the page; remembered in the result.
  Point Put(double x, double y) {
    ++drawn_.points;
    drawn_.x = {std::min(drawn_.x.first, x), std::max(drawn_.x.second, x)};
    drawn_.y = {std::min(drawn_.y.first, y), std::max(drawn_.y.second, y)};
    return frame_.Put(x, y);
  }

  Pen& pen_;
  const Plot& plot_;
  const Frame& frame_;
  Canvas& canvas_;
  DrawnSeries drawn_;
};

}  // namespace

DrawnSeries DrawSeries(Pen& pen, const Plot& plot, const Series& series, const Frame& frame) {
  Draughtsman draughtsman(pen, plot, series, frame);
  std::visit(draughtsman, series.shape);
  return draughtsman.Result();
}

Rgb HeatColour(double fraction) {
  // viridis at each tenth
  static constexpr Rgb kTenths[] = {{68, 1, 84},    {72, 36, 117},  {65, 68, 135},  {53, 95, 141},
                                    {42, 120, 142}, {33, 145, 140}, {34, 168, 132}, {68, 191, 112},
                                    {122, 209, 81}, {189, 223, 38}, {253, 231, 37}};
  constexpr int kSteps = static_cast<int>(std::size(kTenths)) - 1;
  // between two tenths their colours are mixed
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
