// What figures are drawn on: pixels, SVG or PDF, all by cairo.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/report/draw/figure.h"
#include "tools/report/draw/typeface.h"
#include "tools/report/gl/image.h"

namespace warmjoint::report {

class CairoSheet;
struct SvgWords;

enum class FileFormat { png, svg, pdf };

/// The sheet that a canvas makes. Drawing is in points of the figure, which `scale` makes points of
/// the sheet, 1/72 inch.
struct Sheet {
  FileFormat format = FileFormat::png;
  double width = 0;  // points of the figure
  double height = 0;
  double scale = 1;
  double dpi = 144;  // of pixels
  Rgb background;
  double coarseness = 1;  // of SVG and PDF: how much fewer places are told apart
};

/// One line of words.
struct TextLine {
  std::string text;
  Type type;
  Point begin;  // of its baseline
  Rgb colour;
  bool upwards = false;  // runs up the page
};

/// What a picture file says of itself.
struct Description {
  std::string title;
  std::string text;  // alt text
};

/// Draws on one sheet. The same drawing gives the same bytes, whatever was drawn before it.
/// One thread at a time in a process: typefaces are shared.
class Canvas {
 public:
  explicit Canvas(const Sheet& sheet);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  /// How far apart places are that are worth telling apart, points: a pixel, or what print shows.
  double cell() const;

  /// Nothing is drawn outside of the rectangle until Unclip.
  void Clip(const Rectangle& area);
  void Unclip();

  /// Solid, dashed or dotted lines through the points of each path. width: points.
  void Stroke(const std::vector<std::vector<Point>>& paths, Rgb colour, double width,
              Dash dash = Dash::solid);
  void Stroke(Point from, Point to, Rgb colour, double width);
  /// A closed outline.
  void Outline(const Rectangle& area, Rgb colour, double width);
  void Fill(const Rectangle& area, Rgb colour, double opacity = 1);
  void Fill(const std::vector<Point>& polygon, Rgb colour, double opacity = 1);
  /// Filled markers of one series. radius: points.
  void Stamp(const std::vector<Point>& centres, Marker marker, double radius, Rgb colour,
             double opacity = 1);
  /// Where a round pen of that radius went: upright strokes, or dots.
  void Brush(const std::vector<std::pair<Point, Point>>& strokes, double radius, Rgb colour,
             double opacity = 1);
  /// A picture, stretched over the area.
  void Paint(const Image& image, const Rectangle& area);
  /// Colours by place; none where nothing is to be seen. colour: of a point of the area.
  void Paint(const Rectangle& area, const std::function<std::optional<Rgb>(Point)>& colour);
  void Write(const TextLine& line);

  /// The pixels; of PNG sheets alone.
  Image Pixels() const;
  /// The bytes of the file. The canvas cannot be drawn on any more.
  std::string Finish(const Description& description);

 private:
  Sheet sheet_;
  std::unique_ptr<CairoSheet> cairo_;
  std::vector<SvgWords> words_;  // that the finished file gets
};

}  // namespace warmjoint::report
