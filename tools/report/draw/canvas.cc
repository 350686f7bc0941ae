#include "tools/report/draw/canvas.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/report/draw/cairo_sheet.h"
#include "tools/report/draw/svg_file.h"

namespace warmjoint::report {
namespace {

constexpr double kVectorCell = 1.25;  // points between places that are told apart in SVG and PDF
constexpr double kFineCells = 3;      // pixels for each point in what SVG and PDF hold as pixels

std::uint32_t Opaque(Rgb colour) {
  return 0xFF000000u | std::uint32_t{colour.red} << 16 | std::uint32_t{colour.green} << 8 |
         colour.blue;
}

}  // namespace

Canvas::Canvas(const Sheet& sheet) : sheet_(sheet), cairo_(std::make_unique<CairoSheet>(sheet)) {
  Fill({0, 0, sheet.width, sheet.height}, sheet.background);
}

Canvas::~Canvas() = default;

double Canvas::cell() const {
  return sheet_.format == FileFormat::png ? 1 / cairo_->factor()
                                          : sheet_.coarseness * kVectorCell / sheet_.scale;
}

void Canvas::Clip(const Rectangle& area) { cairo_->Clip(area); }

void Canvas::Unclip() { cairo_->Unclip(); }

void Canvas::Stroke(const std::vector<std::vector<Point>>& paths, Rgb colour, double width,
                    Dash dash) {
  for (const std::vector<Point>& path : paths) {
    if (path.size() > 1) cairo_->Trace(path);
  }
  cairo_->StrokeDashed(dash, colour, width);
}

void Canvas::Stroke(Point from, Point to, Rgb colour, double width) {
  Stroke(std::vector<std::vector<Point>>{{from, to}}, colour, width);
}

void Canvas::Outline(const Rectangle& area, Rgb colour, double width) {
  cairo_->Add(area);
  cairo_->Stroke(colour, width);
}

void Canvas::Fill(const Rectangle& area, Rgb colour, double opacity) {
  cairo_->Add(area);
  cairo_->Fill(colour, opacity);
}

void Canvas::Fill(const std::vector<Point>& polygon, Rgb colour, double opacity) {
  if (polygon.size() < 3) return;
  cairo_->Trace(polygon);
  cairo_->Close();
  cairo_->Fill(colour, opacity);
}

void Canvas::Stamp(const std::vector<Point>& centres, Marker marker, double r, Rgb colour,
                   double opacity) {
  const double s = 0.88 * r;  // squares and triangles of the same weight as circles
  // circles are dots of a round pen, all other markers are paths
  std::vector<std::pair<Point, Point>> dots;
  for (const Point& c : centres) {
    switch (marker) {
      case Marker::circle:
        dots.emplace_back(c, c);
        break;
      case Marker::square:
        cairo_->Add({c.x - s, c.y - s, c.x + s, c.y + s});
        break;
      case Marker::diamond:
        cairo_->Trace({{c.x, c.y - 1.3 * r},
                       {c.x + 1.3 * r, c.y},
                       {c.x, c.y + 1.3 * r},
                       {c.x - 1.3 * r, c.y}});
        break;
      case Marker::up:
        cairo_->Trace(
            {{c.x, c.y - 1.3 * r}, {c.x + 1.2 * r, c.y + 0.8 * r}, {c.x - 1.2 * r, c.y + 0.8 * r}});
        break;
      case Marker::down:
        cairo_->Trace(
            {{c.x, c.y + 1.3 * r}, {c.x + 1.2 * r, c.y - 0.8 * r}, {c.x - 1.2 * r, c.y - 0.8 * r}});
        break;
      case Marker::cross:
        cairo_->Trace({{c.x - r, c.y - r}, {c.x + r, c.y + r}});
        cairo_->Trace({{c.x - r, c.y + r}, {c.x + r, c.y - r}});
        break;
    }
  }
  // all markers are painted in one go, so that overlaps are no darker than the rest
  if (marker == Marker::circle) {
    Brush(dots, r, colour, opacity);
  } else if (marker == Marker::cross) {
    cairo_->Stroke(colour, 0.6 * r, opacity);
  } else {
    cairo_->Fill(colour, opacity);
  }
}

void Canvas::Brush(const std::vector<std::pair<Point, Point>>& strokes, double radius, Rgb colour,
                   double opacity) {
  for (const auto& [from, to] : strokes) {
    cairo_->MoveTo(from);
    cairo_->LineTo(to);
  }
  cairo_->StrokeRound(colour, 2 * radius, opacity);
}

void Canvas::Paint(const Image& image, const Rectangle& area) {
  std::vector<std::uint32_t> pixels;
  pixels.reserve(image.pixels.size() / 3);
  for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
    pixels.push_back(Opaque({image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]}));
  }
  // shrunk pixels are means of what they cover, stretched ones stay what they are
  const bool shrinks = cairo_->factor() * area.width() < image.width;
  cairo_->Paint(pixels, image.width, image.height, area,
                shrinks ? CAIRO_FILTER_GOOD : CAIRO_FILTER_NEAREST);
}

void Canvas::Paint(const Rectangle& area, const std::function<std::optional<Rgb>(Point)>& colour) {
  // as many cells as the sheet has pixels, or as a vector file is worth
  const double fineness = sheet_.format == FileFormat::png ? cairo_->factor() : kFineCells;
  const int width = std::max(1, static_cast<int>(std::lround(fineness * area.width())));
  const int height = std::max(1, static_cast<int>(std::lround(fineness * area.height())));
  std::vector<std::uint32_t> pixels(static_cast<std::size_t>(width) * height, 0);
  // each cell has the colour of its middle, or none
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const auto own = colour({area.left + area.width() * (column + 0.5) / width,
                               area.top + area.height() * (row + 0.5) / height});
      if (own) pixels[static_cast<std::size_t>(row) * width + column] = Opaque(*own);
    }
  }
  cairo_->Paint(pixels, width, height, area, CAIRO_FILTER_NEAREST);
}

void Canvas::Write(const TextLine& line) {
  if (sheet_.format != FileFormat::svg) return cairo_->Show(line);
  // cairo would write outlines of letters: the words join the finished file
  words_.push_back(
      {line, cairo_->factor(), cairo_->Place(line.begin.x), cairo_->Place(line.begin.y)});
}

Image Canvas::Pixels() const { return cairo_->Pixels(); }

std::string Canvas::Finish(const Description& description) {
  if (sheet_.format == FileFormat::png) {
    return EncodePng(Pixels(), description.text, sheet_.dpi);
  }
  const std::string bytes = cairo_->Finish(description);
  return sheet_.format == FileFormat::pdf ? bytes : CompleteSvg(bytes, words_, description);
}

}  // namespace warmjoint::report
