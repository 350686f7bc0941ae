// A picture as data: figure -> panels -> series. FigureJson writes it; tools/python/warmjoint/draw.py draws that.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "models/foundation/serialize.h"

namespace warmjoint::figures {

enum class Scale { linear, logarithmic };
enum class Dash { solid, dashed, dotted };
enum class Marker { circle, square, diamond, up, down, cross };
enum class Side { left, centre, right };
/// Colours by role. Blue to sky are the palette of Okabe and Ito (2008), which colour-blind readers
/// tell apart; caution is for words alone. A style of the backend says how each looks.
enum class Hue { text, grey, blue, vermilion, green, purple, orange, sky, caution };

inline std::span<const Word<Scale>> WordsOf(Scale) {
  static constexpr std::array words{Word{"linear", Scale::linear},
                                    Word{"logarithmic", Scale::logarithmic}};
  return words;
}
inline std::span<const Word<Dash>> WordsOf(Dash) {
  static constexpr std::array words{Word{"solid", Dash::solid}, Word{"dashed", Dash::dashed},
                                    Word{"dotted", Dash::dotted}};
  return words;
}
inline std::span<const Word<Marker>> WordsOf(Marker) {
  static constexpr std::array words{
      Word{"circle", Marker::circle},   Word{"square", Marker::square},
      Word{"diamond", Marker::diamond}, Word{"up", Marker::up},
      Word{"down", Marker::down},       Word{"cross", Marker::cross}};
  return words;
}
inline std::span<const Word<Side>> WordsOf(Side) {
  static constexpr std::array words{Word{"left", Side::left}, Word{"centre", Side::centre},
                                    Word{"right", Side::right}};
  return words;
}
inline std::span<const Word<Hue>> WordsOf(Hue) {
  static constexpr std::array words{
      Word{"text", Hue::text},           Word{"grey", Hue::grey},   Word{"blue", Hue::blue},
      Word{"vermilion", Hue::vermilion}, Word{"green", Hue::green}, Word{"purple", Hue::purple},
      Word{"orange", Hue::orange},       Word{"sky", Hue::sky},     Word{"caution", Hue::caution}};
  return words;
}

/// One of several kinds of thing: its members, and its kind.
template <typename... Kinds>
Tree KindTree(const std::variant<Kinds...>& value) {
  return std::visit(
      [](const auto& one) {
        Tree tree = WriteFields(one);
        tree["kind"] = one.kKind;
        return tree;
      },
      value);
}

/// A named place on an axis.
struct Tick {
  double value = 0;
  std::string label;  // empty: no mark either

  template <class A>
  void Serialize(A* a) {
    a->Field("value", &value);
    a->Field("label", &label);
  }
};

struct Axis {
  std::string label;  // with its unit: "speed (rad/s)"
  double lower = 0;   // lower < upper; above 0 where logarithmic
  double upper = 1;
  Scale scale = Scale::linear;
  std::vector<Tick> ticks{};  // empty: round numbers
  double finest = 0;          // ticks stand no closer: 1 on an axis that counts

  template <class A>
  void Serialize(A* a) {
    a->Field("label", &label);
    a->Field("lower", &lower);
    a->Field("upper", &upper);
    a->Field("scale", &scale);
    a->Field("ticks", &ticks);
    a->Field("finest", &finest);
  }
};

/// y over x; NaN interrupts. x, y: [N].
struct Line {
  static constexpr const char* kKind = "line";
  Eigen::VectorXd x;
  Eigen::VectorXd y;
  double width = 1.5;  // points
  Dash dash = Dash::solid;

  template <class A>
  void Serialize(A* a) {
    a->Field("x", &x);
    a->Field("y", &y);
    a->Field("width", &width);
    a->Field("dash", &dash);
  }
};

/// Markers at (x, y). x, y: [N].
struct Scatter {
  static constexpr const char* kKind = "scatter";
  Eigen::VectorXd x;
  Eigen::VectorXd y;
  double size = 2.5;  // radius, points
  Marker marker = Marker::circle;
  double opacity = 1;

  template <class A>
  void Serialize(A* a) {
    a->Field("x", &x);
    a->Field("y", &y);
    a->Field("size", &size);
    a->Field("marker", &marker);
    a->Field("opacity", &opacity);
  }
};

/// The area between two curves. x, lower, upper: [N].
struct Band {
  static constexpr const char* kKind = "band";
  Eigen::VectorXd x;
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
  double opacity = 0.22;

  template <class A>
  void Serialize(A* a) {
    a->Field("x", &x);
    a->Field("lower", &lower);
    a->Field("upper", &upper);
    a->Field("opacity", &opacity);
  }
};

/// Upright bars from zero (linear) or from the lower limit (logarithmic). x, height: [N].
struct Bars {
  static constexpr const char* kKind = "bars";
  Eigen::VectorXd x;  // centres
  Eigen::VectorXd height;
  double width = 0.8;
  double opacity = 1;

  template <class A>
  void Serialize(A* a) {
    a->Field("x", &x);
    a->Field("height", &height);
    a->Field("width", &width);
    a->Field("opacity", &opacity);
  }
};

/// A box plot of one sample.
struct Box {
  static constexpr const char* kKind = "box";
  double x = 0;
  double lower = 0;  // whisker
  double q25 = 0;
  double median = 0;
  double q75 = 0;
  double upper = 0;          // whisker
  Eigen::VectorXd outliers;  // beyond the whiskers
  double width = 0.5;

  template <class A>
  void Serialize(A* a) {
    a->Field("x", &x);
    a->Field("lower", &lower);
    a->Field("q25", &q25);
    a->Field("median", &median);
    a->Field("q75", &q75);
    a->Field("upper", &upper);
    a->Field("outliers", &outliers);
    a->Field("width", &width);
  }
};

/// Cells coloured by value over a rectangle. values: [rows x columns], row 0 at the lowest y;
/// NaN cells stay empty. The plot gets a colour bar.
struct HeatMap {
  static constexpr const char* kKind = "heat_map";
  Eigen::MatrixXd values;
  std::pair<double, double> x;  // lower, upper edge
  std::pair<double, double> y;
  std::pair<double, double> limits;    // values at the ends of the colour scale
  std::string label;                   // of the colour bar, with unit
  std::vector<std::string> colours{};  // "#2166ac", ...: of the scale; empty: the usual ones

  template <class A>
  void Serialize(A* a) {
    a->Field("values", &values);
    a->Field("x", &x);
    a->Field("y", &y);
    a->Field("limits", &limits);
    a->Field("label", &label);
    a->Field("colours", &colours);
  }
};

/// A straight line across the whole plot.
struct LevelLine {
  static constexpr const char* kKind = "level";
  double value = 0;
  Dash dash = Dash::dashed;
  bool vertical = false;
  double width = 1.2;  // points

  template <class A>
  void Serialize(A* a) {
    a->Field("value", &value);
    a->Field("dash", &dash);
    a->Field("vertical", &vertical);
    a->Field("width", &width);
  }
};

/// Words at a place; `side` says which end of the words stands there.
struct Note {
  static constexpr const char* kKind = "note";
  double x = 0;
  double y = 0;
  std::string text;
  Side side = Side::left;

  template <class A>
  void Serialize(A* a) {
    a->Field("x", &x);
    a->Field("y", &y);
    a->Field("text", &text);
    a->Field("side", &side);
  }
};

using Shape = std::variant<Line, Scatter, Band, Bars, Box, HeatMap, LevelLine, Note>;
inline Tree WriteValue(const Shape& shape) { return KindTree(shape); }

struct Series {
  std::string label;  // in the legend; empty: not there
  Hue hue = Hue::blue;
  Shape shape;

  template <class A>
  void Serialize(A* a) {
    a->Field("label", &label);
    a->Field("hue", &hue);
    a->Field("shape", &shape);
  }
};

/// Axes and what is drawn between them, in this order.
struct Plot {
  static constexpr const char* kKind = "plot";
  Axis x;
  Axis y;
  std::vector<Series> series;

  template <class A>
  void Serialize(A* a) {
    a->Field("x", &x);
    a->Field("y", &y);
    a->Field("series", &series);
  }
};

/// Paragraphs, wrapped at the panel's width.
struct Words {
  static constexpr const char* kKind = "words";
  struct Paragraph {
    std::string text;
    bool bold = false;
    Hue hue = Hue::text;

    template <class A>
    void Serialize(A* a) {
      a->Field("text", &text);
      a->Field("bold", &bold);
      a->Field("hue", &hue);
    }
  };
  std::vector<Paragraph> paragraphs;

  template <class A>
  void Serialize(A* a) {
    a->Field("paragraphs", &paragraphs);
  }
};

/// A table; the first row is its head. Columns but the first are set to the right.
struct Table {
  static constexpr const char* kKind = "table";
  std::vector<std::vector<std::string>> rows;

  template <class A>
  void Serialize(A* a) {
    a->Field("rows", &rows);
  }
};

/// A photograph or rendering, kept in proportion.
struct Picture {
  static constexpr const char* kKind = "picture";
  std::string png;  // bytes of the file; base 64 where written

  template <class A>
  void Serialize(A* a) {
    std::string text = Base64(png);
    a->Field("png", &text);
  }

  /// RFC 4648.
  static std::string Base64(std::string_view bytes);
};

using Content = std::variant<Plot, Words, Table, Picture>;
inline Tree WriteValue(const Content& content) { return KindTree(content); }

struct Panel {
  std::string title;
  Content content;
  int row = 0;
  int column = 0;
  int row_span = 1;
  int column_span = 1;
  std::optional<Hue> frame = std::nullopt;  // around what a reader must not miss

  template <class A>
  void Serialize(A* a) {
    a->Field("title", &title);
    a->Field("content", &content);
    a->Field("row", &row);
    a->Field("column", &column);
    a->Field("row_span", &row_span);
    a->Field("column_span", &column_span);
    a->Field("frame", &frame);
  }
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
  std::vector<Panel> panels{};

  template <class A>
  void Serialize(A* a) {
    a->Field("name", &name);
    a->Field("title", &title);
    a->Field("subtitle", &subtitle);
    a->Field("finding", &finding);
    a->Field("width", &width);
    a->Field("height", &height);
    a->Field("rows", &rows);
    a->Field("columns", &columns);
    a->Field("panels", &panels);
  }
};

/// The figure for the backend: series of many samples are thinned to what its plots can show, without losing an extreme.
Tree FigureJson(Figure figure);

/// All that the figure's plots show, before any thinning, as CSV: panel, series, kind, x, y, lower,
/// upper, value. kind: line, dot, band, bar, box (y: median; lower, upper: quartiles), whiskers,
/// outlier, cell (value: its colour), level (x or y). Lines that begin with # name the axes with their
/// units. Numbers have all their digits.
std::string FigureCsv(const Figure& figure);

/// One figure of a family; nothing where `view` has no data for it.
template <typename View>
struct NamedFigure {
  std::string name;     // of the file
  std::string summary;  // what it shows, one line
  std::optional<Figure> (*make)(const View& view);
  std::string needs;  // what a view without it lacks
};

}  // namespace warmjoint::figures
