#include "tools/report/draw/canvas.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "models/foundation/bad_input.h"
#include "models/foundation/printable.h"
#include "tools/report/draw/svg_file.h"

namespace warmjoint::report {
namespace {

constexpr double kPointsPerInch = 72;
constexpr double kFinest = 8;          // places in SVG and PDF, for each point: 44 um apart
constexpr double kVectorCell = 1.25;   // points between places that are told apart there
constexpr double kFineCells = 3;       // pixels for each point in what SVG and PDF hold as pixels
constexpr double kMostPixels = 20000;  // of a side

cairo_status_t Append(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

/// Device units for each point of the figure.
double FactorOf(const Sheet& sheet) {
  return sheet.scale * (sheet.format == FileFormat::png ? sheet.dpi / kPointsPerInch : 1);
}

cairo_surface_t* SurfaceOf(const Sheet& sheet, std::string* bytes) {
  const double width = FactorOf(sheet) * sheet.width, height = FactorOf(sheet) * sheet.height;
  cairo_surface_t* surface = nullptr;
  switch (sheet.format) {
    case FileFormat::png:
      if (width > kMostPixels || height > kMostPixels) {
        Refuse({},
               "a picture of {:.0f} x {:.0f} pixels is too large; take fewer than {:.0f} a side",
               width, height, kMostPixels);
      }
      return cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::lround(width)),
                                        static_cast<int>(std::lround(height)));
    case FileFormat::svg:
      surface = cairo_svg_surface_create_for_stream(&Append, bytes, width, height);
      cairo_svg_surface_restrict_to_version(surface, CAIRO_SVG_VERSION_1_1);
      return surface;
    case FileFormat::pdf:
      surface = cairo_pdf_surface_create_for_stream(&Append, bytes, width, height);
      // a date of making would differ from run to run
      cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, nullptr);
      return surface;
  }
  return surface;
}

std::uint32_t Opaque(Rgb colour) {
  return 0xFF000000u | std::uint32_t{colour.red} << 16 | std::uint32_t{colour.green} << 8 |
         colour.blue;
}

}  // namespace

struct Canvas::Cairo {
  explicit Cairo(const Sheet& sheet)
      : factor(FactorOf(sheet)),
        finest(sheet.format == FileFormat::png ? 0 : kFinest),
        surface(SurfaceOf(sheet, &bytes)),
        context(cairo_create(surface)) {
    if (cairo_status(context) != CAIRO_STATUS_SUCCESS) {
      Refuse({}, "a picture of {:.0f} x {:.0f} points cannot be made: {}", sheet.width,
             sheet.height, cairo_status_to_string(cairo_status(context)));
    }
    cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  }
  ~Cairo() {
    cairo_destroy(context);
    cairo_surface_destroy(surface);
  }
  Cairo(const Cairo&) = delete;
  Cairo& operator=(const Cairo&) = delete;

  /// A place of the device: round where files hold it as digits.
  double Place(double points) const {
    const double at = factor * points;
    return finest > 0 ? std::round(finest * at) / finest : at;
  }
  void MoveTo(Point p) { cairo_move_to(context, Place(p.x), Place(p.y)); }
  void LineTo(Point p) { cairo_line_to(context, Place(p.x), Place(p.y)); }
  void Trace(const std::vector<Point>& path) {
    cairo_new_sub_path(context);
    for (const Point& p : path) LineTo(p);
  }
  void Add(const Rectangle& area) {
    const double left = Place(area.left), top = Place(area.top);
    cairo_rectangle(context, left, top, Place(area.right) - left, Place(area.bottom) - top);
  }
  void Colour(Rgb colour, double opacity) {
    cairo_set_source_rgba(context, colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0,
                          opacity);
  }
  void Stroke(Rgb colour, double width, double opacity = 1) {
    Colour(colour, opacity);
    cairo_set_line_width(context, factor * width);
    cairo_stroke(context);
  }
  void Fill(Rgb colour, double opacity) {
    Colour(colour, opacity);
    cairo_fill(context);
  }
  void Pattern(Dash dash, double width) {
    const double mark = dash == Dash::dashed ? 5 + width : width;
    const double gap = dash == Dash::dashed ? 3.5 + width : 2 + width;
    const double lengths[] = {factor * mark, factor * gap};
    cairo_set_dash(context, lengths, dash == Dash::solid ? 0 : 2, 0);
  }

  /// Stretches pixels over the area. pixels: ARGB, rows from the top; unchanged.
  void Paint(std::vector<std::uint32_t>& pixels, int width, int height, const Rectangle& area,
             cairo_filter_t filter) {
    cairo_surface_t* image =
        cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(pixels.data()),
                                            CAIRO_FORMAT_ARGB32, width, height, 4 * width);
    cairo_save(context);
    cairo_translate(context, Place(area.left), Place(area.top));
    cairo_scale(context, factor * area.width() / width, factor * area.height() / height);
    cairo_set_source_surface(context, image, 0, 0);
    cairo_pattern_set_filter(cairo_get_source(context), filter);
    cairo_pattern_set_extend(cairo_get_source(context), CAIRO_EXTEND_PAD);
    cairo_rectangle(context, 0, 0, width, height);
    cairo_fill(context);
    cairo_restore(context);
    cairo_surface_finish(image);
    cairo_surface_destroy(image);
  }

  /// Words as outlines or, in PDF, as words.
  void Show(const TextLine& line, FileFormat format) {
    cairo_save(context);
    cairo_translate(context, Place(line.begin.x), Place(line.begin.y));
    if (line.upwards) cairo_rotate(context, -M_PI / 2);
    Colour(line.colour, 1);
    for (const Run& run : RunsOf(line.text, line.type)) {
      cairo_set_font_face(context, FaceOf(run.type));
      cairo_set_font_size(context, factor * EmOf(run.type));
      cairo_move_to(context, factor * run.left, factor * run.drop);
      if (format == FileFormat::pdf) {
        cairo_show_text(context, run.text.c_str());
        continue;
      }
      // glyphs would move to whole pixels
      cairo_text_path(context, run.text.c_str());
      cairo_fill(context);
    }
    cairo_restore(context);
  }

  double factor;
  double finest;
  std::string bytes;
  cairo_surface_t* surface;
  cairo_t* context;
  std::vector<SvgWords> words;
};

Canvas::Canvas(const Sheet& sheet) : sheet_(sheet), cairo_(std::make_unique<Cairo>(sheet)) {
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(cairo_->context, options);
  cairo_font_options_destroy(options);
  Fill({0, 0, sheet.width, sheet.height}, sheet.background);
}

Canvas::~Canvas() = default;

double Canvas::cell() const {
  return sheet_.format == FileFormat::png ? 1 / cairo_->factor
                                          : sheet_.coarseness * kVectorCell / sheet_.scale;
}

void Canvas::Clip(const Rectangle& area) {
  cairo_save(cairo_->context);
  cairo_->Add(area);
  cairo_clip(cairo_->context);
}

void Canvas::Unclip() { cairo_restore(cairo_->context); }

void Canvas::Stroke(const std::vector<std::vector<Point>>& paths, Rgb colour, double width,
                    Dash dash) {
  for (const std::vector<Point>& path : paths) {
    if (path.size() > 1) cairo_->Trace(path);
  }
  cairo_->Pattern(dash, width);
  cairo_->Stroke(colour, width);
  cairo_->Pattern(Dash::solid, width);
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
  cairo_close_path(cairo_->context);
  cairo_->Fill(colour, opacity);
}

void Canvas::Stamp(const std::vector<Point>& centres, Marker marker, double r, Rgb colour,
                   double opacity) {
  const double s = 0.88 * r;  // squares and triangles of the same weight as circles
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
  cairo_set_line_cap(cairo_->context, CAIRO_LINE_CAP_ROUND);
  cairo_->Stroke(colour, 2 * radius, opacity);
  cairo_set_line_cap(cairo_->context, CAIRO_LINE_CAP_BUTT);
}

void Canvas::Paint(const Image& image, const Rectangle& area) {
  std::vector<std::uint32_t> pixels;
  pixels.reserve(image.pixels.size() / 3);
  for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
    pixels.push_back(Opaque({image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]}));
  }
  // shrunk pixels are means of what they cover, stretched ones stay what they are
  const bool shrinks = cairo_->factor * area.width() < image.width;
  cairo_->Paint(pixels, image.width, image.height, area,
                shrinks ? CAIRO_FILTER_GOOD : CAIRO_FILTER_NEAREST);
}

void Canvas::Paint(const Rectangle& area, const std::function<std::optional<Rgb>(Point)>& colour) {
  const double fineness = sheet_.format == FileFormat::png ? cairo_->factor : kFineCells;
  const int width = std::max(1, static_cast<int>(std::lround(fineness * area.width())));
  const int height = std::max(1, static_cast<int>(std::lround(fineness * area.height())));
  std::vector<std::uint32_t> pixels(static_cast<std::size_t>(width) * height, 0);
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
  if (sheet_.format != FileFormat::svg) return cairo_->Show(line, sheet_.format);
  // cairo would write outlines of letters: the words join the finished file
  cairo_->words.push_back(
      {line, cairo_->factor, cairo_->Place(line.begin.x), cairo_->Place(line.begin.y)});
}

Image Canvas::Pixels() const {
  assert(sheet_.format == FileFormat::png);
  cairo_surface_flush(cairo_->surface);
  Image image{cairo_image_surface_get_width(cairo_->surface),
              cairo_image_surface_get_height(cairo_->surface),
              {}};
  const int stride = cairo_image_surface_get_stride(cairo_->surface);
  const unsigned char* data = cairo_image_surface_get_data(cairo_->surface);
  image.pixels.reserve(std::size_t{3} * image.width * image.height);
  for (int y = 0; y < image.height; ++y) {
    const auto* row = reinterpret_cast<const std::uint32_t*>(data + std::ptrdiff_t{y} * stride);
    for (int x = 0; x < image.width; ++x) {
      for (int shift : {16, 8, 0})
        image.pixels.push_back(static_cast<std::uint8_t>(row[x] >> shift));
    }
  }
  return image;
}

std::string Canvas::Finish(const Description& description) {
  if (sheet_.format == FileFormat::png) {
    return EncodePng(Pixels(), description.text, sheet_.dpi);
  }
  if (sheet_.format == FileFormat::pdf) {
    const std::string title = Printable(description.title), text = Printable(description.text);
    cairo_pdf_surface_set_metadata(cairo_->surface, CAIRO_PDF_METADATA_TITLE, title.c_str());
    cairo_pdf_surface_set_metadata(cairo_->surface, CAIRO_PDF_METADATA_SUBJECT, text.c_str());
  }
  cairo_show_page(cairo_->context);
  cairo_surface_finish(cairo_->surface);
  if (sheet_.format == FileFormat::pdf) return cairo_->bytes;
  return CompleteSvg(cairo_->bytes, cairo_->words, description);
}

}  // namespace warmjoint::report
