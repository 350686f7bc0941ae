#include "tools/figures/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <cmath>
#include <iterator>

#include "tools/figures/reduce.h"

namespace warmjoint::figures {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// columns of a curve that are told apart: more than a page at 300 pixels an inch shows
constexpr int kColumns = 2000;
constexpr Index kCrowd = 3000;  // samples that are all kept
// cells of a crowd: across a whole page they are closer than the smallest markers are wide
constexpr int kCrowdColumns = 480, kCrowdRows = 240;

/// The part of an axis that is shown, in the coordinate in which it is straight.
CellSpan SpanOf(const Axis& axis, int count) {
  if (axis.scale == Scale::linear) return {axis.lower, axis.upper, count};
  return {std::log10(axis.lower), std::log10(axis.upper), count};
}

/// Values in that coordinate; NaN where a logarithmic axis has no place for them.
VectorXd OnAxis(const VectorXd& values, const Axis& axis) {
  if (axis.scale == Scale::linear) return values;
  return values.unaryExpr([](double v) { return v > 0 ? std::log10(v) : NAN; });
}

/// Leaves the samples that a plot of these axes shows; one function for each shape.
struct Thinning {
  const Plot& plot;

  void operator()(Line& line) const {
    const std::vector<Index> kept = CurveOf(line.x, line.y);
    line.x = VectorXd(line.x(kept));
    line.y = VectorXd(line.y(kept));
  }
  void operator()(Band& band) const {
    // what either edge needs
    const std::vector<Index> below = CurveOf(band.x, band.lower);
    const std::vector<Index> above = CurveOf(band.x, band.upper);
    std::vector<Index> kept;
    std::set_union(below.begin(), below.end(), above.begin(), above.end(),
                   std::back_inserter(kept));
    for (VectorXd* values : {&band.x, &band.lower, &band.upper}) {
      *values = VectorXd((*values)(kept));
    }
  }
  void operator()(Scatter& scatter) const {
    if (scatter.x.size() <= kCrowd) return;
    const std::vector<Index> kept =
        ReduceCloud(OnAxis(scatter.x, plot.x), OnAxis(scatter.y, plot.y),
                    SpanOf(plot.x, kCrowdColumns), SpanOf(plot.y, kCrowdRows));
    scatter.x = VectorXd(scatter.x(kept));
    scatter.y = VectorXd(scatter.y(kept));
  }
  template <typename Other>
  void operator()(Other&) const {}

 private:
  std::vector<Index> CurveOf(const VectorXd& x, const VectorXd& y) const {
    return ReduceCurve(OnAxis(x, plot.x), OnAxis(y, plot.y), SpanOf(plot.x, kColumns));
  }
};

/// A field of CSV, quoted where it must be.
std::string Quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r#") == text.npos) return text;
  std::string quoted = "\"";
  for (char letter : text) {
    if (letter == '"') quoted += '"';
    quoted += letter == '\n' || letter == '\r' ? ' ' : letter;
  }
  return quoted + '"';
}

/// One line of the table; what is NaN stays empty.
struct Row {
  double x = NAN, y = NAN, lower = NAN, upper = NAN, value = NAN;
};

/// Writes the rows of one series; one function for each shape.
class Writer {
 public:
  Writer(std::string head, std::string& csv) : head_(std::move(head)), csv_(csv) {}

  void operator()(const Line& line) { Points("line", line.x, line.y); }
  void operator()(const Scatter& scatter) { Points("dot", scatter.x, scatter.y); }
  void operator()(const Bars& bars) { Points("bar", bars.x, bars.height); }
  void operator()(const Band& band) {
    for (Index i = 0; i < band.x.size(); ++i) {
      Add("band", {band.x[i], NAN, band.lower[i], band.upper[i]});
    }
  }
  void operator()(const Box& box) {
    Add("box", {box.x, box.median, box.q25, box.q75});
    Add("whiskers", {box.x, NAN, box.lower, box.upper});
    for (double value : box.outliers) Add("outlier", {box.x, value});
  }
  void operator()(const HeatMap& map) {
    const Index rows = map.values.rows(), columns = map.values.cols();
    const auto middle = [](const std::pair<double, double>& range, Index i, Index count) {
      return range.first + (range.second - range.first) * (static_cast<double>(i) + 0.5) /
                               static_cast<double>(count);
    };
    // each cell by its middle and its value
    for (Index row = 0; row < rows; ++row) {
      for (Index column = 0; column < columns; ++column) {
        Add("cell", {middle(map.x, column, columns), middle(map.y, row, rows), NAN, NAN,
                     map.values(row, column)});
      }
    }
  }
  void operator()(const LevelLine& level) {
    Add("level", level.vertical ? Row{level.value} : Row{NAN, level.value});
  }
  void operator()(const Note&) {}

 private:
  void Points(const char* kind, const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
    for (Index i = 0; i < x.size(); ++i) Add(kind, {x[i], y[i]});
  }
  void Add(const char* kind, const Row& row) {
    auto out = std::back_inserter(csv_);
    fmt::format_to(out, "{}{}", head_, kind);
    // columns that a shape has no number for stay empty
    for (double number : {row.x, row.y, row.lower, row.upper, row.value}) {
      if (std::isnan(number)) {
        csv_ += ',';
      } else {
        fmt::format_to(out, ",{}", number);
      }
    }
    csv_ += '\n';
  }

  std::string head_;
  std::string& csv_;
};

}  // namespace

Tree FigureJson(Figure figure) {
  for (Panel& panel : figure.panels) {
    auto* plot = std::get_if<Plot>(&panel.content);
    if (!plot) continue;
    for (Series& series : plot->series) std::visit(Thinning{*plot}, series.shape);
  }
  return WriteFields(std::move(figure));
}

std::string Picture::Base64(std::string_view bytes) {
  namespace iterators = boost::archive::iterators;
  using Sixes = iterators::transform_width<std::string_view::const_iterator, 6, 8>;
  using Letters = iterators::base64_from_binary<Sixes>;
  const std::string text(Letters(bytes.begin()), Letters(bytes.end()));
  // bytes that the last group of three lacks are written as =
  return text + std::string((3 - bytes.size() % 3) % 3, '=');
}

std::string FigureCsv(const Figure& figure) {
  std::string axes, rows;
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const Panel& panel = figure.panels[i];
    const auto* plot = std::get_if<Plot>(&panel.content);
    if (!plot) continue;
    // panels and series without a name are numbered
    const std::string name = panel.title.empty() ? fmt::format("panel {}", i + 1) : panel.title;
    axes += fmt::format("# {}: x is {}; y is {}\n", name, plot->x.label, plot->y.label);
    // every series goes to the same table, with the names of its panel and its own
    for (std::size_t k = 0; k < plot->series.size(); ++k) {
      const Series& series = plot->series[k];
      const std::string label =
          series.label.empty() ? fmt::format("series {}", k + 1) : series.label;
      std::visit(Writer(Quoted(name) + ',' + Quoted(label) + ',', rows), series.shape);
    }
  }
  return axes + "panel,series,kind,x,y,lower,upper,value\n" + rows;
}

}  // namespace warmjoint::figures
