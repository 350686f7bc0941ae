// The sheet of cairo that a canvas draws on, in points of the figure.
#pragma once

#include <cairo.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tools/report/draw/canvas.h"

namespace warmjoint::report {

/// A surface for one file format, and what is drawn on it next: a path, then its stroke or fill.
class CairoSheet {
 public:
  /// Throws BadInput where cairo cannot make a surface as large.
  explicit CairoSheet(const Sheet& sheet);
  ~CairoSheet();
  CairoSheet(const CairoSheet&) = delete;
  CairoSheet& operator=(const CairoSheet&) = delete;

  /// Device units for each point of the figure.
  double factor() const { return factor_; }
  /// A place of the device: round where files hold it as digits. points: of the figure.
  double Place(double points) const;

  void Clip(const Rectangle& area);
  void Unclip();

  // the path
  void MoveTo(Point p) { cairo_move_to(context_, Place(p.x), Place(p.y)); }
  void LineTo(Point p) { cairo_line_to(context_, Place(p.x), Place(p.y)); }
  void Trace(const std::vector<Point>& path);
  void Close() { cairo_close_path(context_); }
  void Add(const Rectangle& area);

  // what becomes of it; width: points
  void Stroke(Rgb colour, double width, double opacity = 1);
  void StrokeDashed(Dash dash, Rgb colour, double width);
  void StrokeRound(Rgb colour, double width, double opacity);
  void Fill(Rgb colour, double opacity);

  /// Stretches pixels over the area. pixels: ARGB, rows from the top; unchanged.
  void Paint(std::vector<std::uint32_t>& pixels, int width, int height, const Rectangle& area,
             cairo_filter_t filter);

  /// Words as outlines or, in PDF, as words.
  void Show(const TextLine& line);

  /// The pixels; of PNG sheets alone.
  Image Pixels() const;
  /// The bytes of an SVG or PDF file; nothing can be drawn any more.
  std::string Finish(const Description& description);

 private:
  void Colour(Rgb colour, double opacity);

  FileFormat format_;
  double factor_;
  double finest_;  // places for each point; 0: as they are
  std::string bytes_;
  cairo_surface_t* surface_;
  cairo_t* context_;
};

}  // namespace warmjoint::report
