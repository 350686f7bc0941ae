// A picture said, not drawn: figure -> panels -> series.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tools/report/draw/theme.h"
#include "tools/report/gl/image.h"

namespace warmjoint::report {

enum class Scale { linear, logarithmic };
enum class Dash { solid, dashed, dotted };
enum class Marker { circle, square, diamond, up, down, cross };
enum class Side { left, centre, right };

/// A named place on an axis.
struct Tick {
  double value = 0;
  std::string label;  // empty: no mark either
};

struct Axis {
  std::string label;  // with its unit: "speed (rad/s)"
  double lower = 0;   // lower < upper; above 0 where logarithmic
  double upper = 1;
  Scale scale = Scale::linear;
  std::vector<Tick> ticks;  // empty: round numbers
  double finest = 0;        // ticks stand no closer: 1 on an axis that counts
};

/// y over x; NaN interrupts. x, y: [N].
struct Line {
  Eigen::VectorXd x;
  Eigen::VectorXd y;
  double width = 1.5;  // points
  Dash dash = Dash::solid;
};

/// Markers at (x, y). x, y: [N].
struct Scatter {
  Eigen::VectorXd x;
  Eigen::VectorXd y;
  double size = 2.5;  // radius, points
  Marker marker = Marker::circle;
  double opacity = 1;
};

/// The area between two curves. x, lower, upper: [N].
struct Band {
  Eigen::VectorXd x;
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
  double opacity = 0.22;
};

/// Upright bars from zero (linear) or from the lower limit (logarithmic). x, height: [N].
struct Bars {
  Eigen::VectorXd x;  // centres
  Eigen::VectorXd height;
  double width = 0.8;
  double opacity = 1;
};

/// A box plot of one sample.
struct Box {
  double x = 0;
  double lower = 0;  // whisker
  double q25 = 0;
  double median = 0;
  double q75 = 0;
  double upper = 0;          // whisker
  Eigen::VectorXd outliers;  // beyond the whiskers
  double width = 0.5;
};

/// Cells coloured by value over a rectangle. values: [rows x columns], row 0 at the lowest y;
/// NaN cells stay empty. The plot gets a colour bar.
struct HeatMap {
  Eigen::MatrixXd values;
  std::pair<double, double> x;  // lower, upper edge
  std::pair<double, double> y;
  std::pair<double, double> colours;  // values at the ends of the colour scale
  std::string label;                  // of the colour bar, with unit
};

/// A straight line across the whole plot.
struct LevelLine {
  double value = 0;
  Dash dash = Dash::dashed;
  bool vertical = false;
  double width = 1.2;  // points
};

/// Words at a place; `side` says which end of the words stands there.
struct Note {
  double x = 0;
  double y = 0;
  std::string text;
  Side side = Side::left;
};

struct Series {
  std::string label;  // in the legend; empty: not there
  Hue hue = Hue::blue;
  std::variant<Line, Scatter, Band, Bars, Box, HeatMap, LevelLine, Note> shape;
};

/// Axes and what is drawn between them, in this order.
struct Plot {
  Axis x;
  Axis y;
  std::vector<Series> series;
};

/// Paragraphs, wrapped at the panel's width.
struct Words {
  struct Paragraph {
    std::string text;
    bool bold = false;
    Hue hue = Hue::text;
  };
  std::vector<Paragraph> paragraphs;
};

/// A table; the first row is its head. Columns but the first are set to the right.
struct Table {
  std::vector<std::vector<std::string>> rows;
};

/// A photograph or rendering, kept in proportion.
struct Picture {
  Image image;
};

struct Panel {
  std::string title;
  std::variant<Plot, Words, Table, Picture> content;
  int row = 0;
  int column = 0;
  int row_span = 1;
  int column_span = 1;
  std::optional<Hue> frame = std::nullopt;  // around what a reader must not miss
};

/// One width for all figures: side by side they have words of one size.
inline constexpr double kPageWidth = 960;  // points

struct Figure {
  std::string name;           // of the file, without its end
  std::string title;          // what is shown
  std::string subtitle;       // conditions: suite, realizations, ...
  std::string finding;        // one sentence that says what one sees: the alt text
  double width = kPageWidth;  // points
  double height = 500;        // points; 0: what the rows need, which then are points
  /// Relative heights; 0: what the row's words and tables need.
  std::vector<double> rows{1};
  std::vector<double> columns{1};  // relative widths
  std::vector<Panel> panels;
};

}  // namespace warmjoint::report
