#include "tools/report/draw/cairo_sheet.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>

#include <cassert>
#include <cmath>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"

namespace warmjoint::report {
namespace {

constexpr double kPointsPerInch = 72;
constexpr double kFinest = 8;          // places in SVG and PDF, for each point: 44 um apart
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
      // pixels are held in memory: a picture beyond the limit is refused
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

/// Letters where their outlines say, whatever the pixels.
void LeaveLettersAsTheyAre(cairo_t* context) {
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context, options);
  cairo_font_options_destroy(options);
}

}  // namespace

CairoSheet::CairoSheet(const Sheet& sheet)
    : format_(sheet.format),
      factor_(FactorOf(sheet)),
      finest_(sheet.format == FileFormat::png ? 0 : kFinest),
      surface_(SurfaceOf(sheet, &bytes_)),
      context_(cairo_create(surface_)) {
  // a sheet that cairo cannot make is refused in cairo's own words
  if (cairo_status(context_) != CAIRO_STATUS_SUCCESS) {
    Refuse({}, "a picture of {:.0f} x {:.0f} points cannot be made: {}", sheet.width, sheet.height,
           cairo_status_to_string(cairo_status(context_)));
  }
  cairo_set_line_join(context_, CAIRO_LINE_JOIN_ROUND);
  LeaveLettersAsTheyAre(context_);
}

CairoSheet::~CairoSheet() {
  cairo_destroy(context_);
  cairo_surface_destroy(surface_);
}

double CairoSheet::Place(double points) const {
  const double at = factor_ * points;
  return finest_ > 0 ? std::round(finest_ * at) / finest_ : at;
}

void CairoSheet::Clip(const Rectangle& area) {
  cairo_save(context_);
  Add(area);
  cairo_clip(context_);
}

void CairoSheet::Unclip() { cairo_restore(context_); }

void CairoSheet::Trace(const std::vector<Point>& path) {
  cairo_new_sub_path(context_);
  for (const Point& p : path) LineTo(p);
}

void CairoSheet::Add(const Rectangle& area) {
  const double left = Place(area.left), top = Place(area.top);
  cairo_rectangle(context_, left, top, Place(area.right) - left, Place(area.bottom) - top);
}

void CairoSheet::Colour(Rgb colour, double opacity) {
  cairo_set_source_rgba(context_, colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0,
                        opacity);
}

void CairoSheet::Stroke(Rgb colour, double width, double opacity) {
  Colour(colour, opacity);
  cairo_set_line_width(context_, factor_ * width);
  cairo_stroke(context_);
}

void CairoSheet::StrokeDashed(Dash dash, Rgb colour, double width) {
  const double mark = dash == Dash::dashed ? 5 + width : width;
  const double gap = dash == Dash::dashed ? 3.5 + width : 2 + width;
  const double lengths[] = {factor_ * mark, factor_ * gap};
  cairo_set_dash(context_, lengths, dash == Dash::solid ? 0 : 2, 0);
  Stroke(colour, width);
  cairo_set_dash(context_, lengths, 0, 0);
}

void CairoSheet::StrokeRound(Rgb colour, double width, double opacity) {
  cairo_set_line_cap(context_, CAIRO_LINE_CAP_ROUND);
  Stroke(colour, width, opacity);
  cairo_set_line_cap(context_, CAIRO_LINE_CAP_BUTT);
}

void CairoSheet::Fill(Rgb colour, double opacity) {
  Colour(colour, opacity);
  cairo_fill(context_);
}

void CairoSheet::Paint(std::vector<std::uint32_t>& pixels, int width, int height,
                       const Rectangle& area, cairo_filter_t filter) {
  // the cells become an image that is stretched over the area
  cairo_surface_t* image =
      cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(pixels.data()),
                                          CAIRO_FORMAT_ARGB32, width, height, 4 * width);
  cairo_save(context_);
  cairo_translate(context_, Place(area.left), Place(area.top));
  cairo_scale(context_, factor_ * area.width() / width, factor_ * area.height() / height);
  cairo_set_source_surface(context_, image, 0, 0);
  // cells at the edge reach as far as the area does, so that its border does not fade
  cairo_pattern_set_filter(cairo_get_source(context_), filter);
  cairo_pattern_set_extend(cairo_get_source(context_), CAIRO_EXTEND_PAD);
  cairo_rectangle(context_, 0, 0, width, height);
  cairo_fill(context_);
  cairo_restore(context_);
  cairo_surface_finish(image);
  cairo_surface_destroy(image);
}

void CairoSheet::Show(const TextLine& line) {
  cairo_save(context_);
  cairo_translate(context_, Place(line.begin.x), Place(line.begin.y));
  // words that run upwards are turned about their begin
  if (line.upwards) cairo_rotate(context_, -M_PI / 2);
  Colour(line.colour, 1);
  // indices stand smaller and lower than the words around them
  for (const Run& run : RunsOf(line.text, line.type)) {
    cairo_set_font_face(context_, FaceOf(run.type));
    cairo_set_font_size(context_, factor_ * EmOf(run.type));
    cairo_move_to(context_, factor_ * run.left, factor_ * run.drop);
    // a PDF keeps its letters as text
    if (format_ == FileFormat::pdf) {
      cairo_show_text(context_, run.text.c_str());
      continue;
    }
    // glyphs would move to whole pixels
    cairo_text_path(context_, run.text.c_str());
    cairo_fill(context_);
  }
  cairo_restore(context_);
}

Image CairoSheet::Pixels() const {
  assert(format_ == FileFormat::png);
  // every stroke has to reach the pixels before they are read
  cairo_surface_flush(surface_);
  Image image{
      cairo_image_surface_get_width(surface_), cairo_image_surface_get_height(surface_), {}};
  const int stride = cairo_image_surface_get_stride(surface_);
  const unsigned char* data = cairo_image_surface_get_data(surface_);
  image.pixels.reserve(std::size_t{3} * image.width * image.height);
  // cairo holds four bytes for each pixel, the image takes red, green and blue
  for (int y = 0; y < image.height; ++y) {
    const auto* row = reinterpret_cast<const std::uint32_t*>(data + std::ptrdiff_t{y} * stride);
    for (int x = 0; x < image.width; ++x) {
      for (int shift : {16, 8, 0})
        image.pixels.push_back(static_cast<std::uint8_t>(row[x] >> shift));
    }
  }
  return image;
}

std::string CairoSheet::Finish(const Description& description) {
  if (format_ == FileFormat::pdf) {
    const std::string title = Printable(description.title), text = Printable(description.text);
    cairo_pdf_surface_set_metadata(surface_, CAIRO_PDF_METADATA_TITLE, title.c_str());
    cairo_pdf_surface_set_metadata(surface_, CAIRO_PDF_METADATA_SUBJECT, text.c_str());
  }
  cairo_show_page(context_);
  cairo_surface_finish(surface_);
  return bytes_;
}

}  // namespace warmjoint::report
