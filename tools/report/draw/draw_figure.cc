#include "tools/report/draw/draw_figure.h"

#include <algorithm>
#include <utility>

#include "tools/report/draw/draw_plot.h"
#include "tools/report/draw/draw_words.h"
#include "tools/report/draw/layout.h"
#include "tools/report/draw/pen.h"
#include "tools/report/draw/stacked.h"

namespace warmjoint::report {
namespace {

constexpr double kPointsPerMillimetre = 72 / 25.4;
constexpr std::size_t kLargestVector = 300000;  // bytes
constexpr double kCoarser = 1.4, kCoarsest = 4;
constexpr Type kTitleType{size::kTitle, true}, kSubtitleType{size::kText};

double WidthOfWords(const Figure& figure) { return figure.width - 2 * size::kMargin; }

/// y below title and subtitle.
double BelowHead(const Figure& figure) {
  double y = size::kMargin - 4;
  const double width = WidthOfWords(figure);
  if (!figure.title.empty()) y += Measure(figure.title, kTitleType, width).height + 2;
  if (!figure.subtitle.empty()) y += Measure(figure.subtitle, kSubtitleType, width).height;
  return figure.title.empty() && figure.subtitle.empty() ? y : y + 12;
}

void DrawHead(Pen& pen, const Figure& figure) {
  double y = size::kMargin - 4;
  const double width = WidthOfWords(figure);
  if (!figure.title.empty()) {
    const Point at{size::kMargin, y};
    y += pen.Write(figure.title, kTitleType, at, pen.theme().text, width).height + 2;
  }
  if (!figure.subtitle.empty()) {
    pen.Write(figure.subtitle, kSubtitleType, {size::kMargin, y}, pen.theme().faint_text, width);
  }
}

void DrawPanel(Pen& pen, const Panel& panel, const PanelPlace& place) {
  const auto* plot = std::get_if<Plot>(&panel.content);
  const double right = place.cell.right;
  // titles and legends start with the axis, or with the cell where they are long
  double left = plot ? place.area.left : place.cell.left;
  const Type type{size::kText, true};
  const bool long_legend =
      plot && LegendHeight(*plot, right - left) > LegendHeight(*plot, place.cell.width());
  if (long_legend || Measure(panel.title, type).width > right - left) left = place.cell.left;
  double y = place.cell.top;
  // the title, wrapped to the width of the panel
  if (!panel.title.empty()) {
    y += pen.Write(panel.title, type, {left, y}, pen.theme().text, place.cell.width()).height + 4;
  }
  // a frame that points the panel out
  if (panel.frame) {
    constexpr double kBeside = 6, kWidth = 2;  // points
    const Rectangle& c = place.cell;
    pen.canvas().Outline({c.left - kBeside, c.top - kBeside, c.right + kBeside, c.bottom + kBeside},
                         pen.theme().Colour(*panel.frame), kWidth);
  }
  // below the title what the panel is there to show
  if (plot) {
    DrawLegend(pen, *plot, {left, y}, right - left);
    DrawPlot(pen, panel.title, *plot, place.area, place.cell.left + size::kText / 2 + 2);
  } else if (const auto* words = std::get_if<Words>(&panel.content)) {
    DrawWords(pen, *words, place.area);
  } else if (const auto* table = std::get_if<Table>(&panel.content)) {
    DrawTable(pen, *table, place.area);
  } else if (const auto* picture = std::get_if<Picture>(&panel.content)) {
    DrawPicture(pen, *picture, place.area);
  }
}

/// The figure with a height, once its width is known; refuses before anything is drawn.
Figure Measured(Figure figure) {
  for (const Panel& panel : figure.panels) {
    if (const auto* plot = std::get_if<Plot>(&panel.content)) CheckAxes(*plot);
  }
  if (figure.height == 0) figure.height = NaturalHeight(figure, BelowHead(figure));
  return figure;
}

void Compose(Canvas& canvas, const Figure& figure, const Theme& theme, Drawn& drawn) {
  Pen pen(canvas, theme, drawn);
  const std::vector<PanelPlace> places = LayOut(figure, BelowHead(figure));
  DrawHead(pen, figure);
  for (std::size_t i = 0; i < places.size(); ++i) DrawPanel(pen, figure.panels[i], places[i]);
}

/// What a reader of a thinned picture must know; empty where every sample is drawn.
std::string ThinningOf(const Drawn& drawn) {
  const bool thinned = std::any_of(drawn.plots.begin(), drawn.plots.end(), [](const auto& plot) {
    return std::any_of(plot.series.begin(), plot.series.end(),
                       [](const auto& series) { return series.samples > series.points; });
  });
  if (!thinned) return "";
  return " Long series are thinned; no extreme is lost.";
}

/// The figure on the page that the setting asks for.
Figure OnPage(Figure figure, const PageSetting& setting) {
  // without titles the words stay to the page around the picture
  if (!setting.titled) {
    figure.title.clear();
    figure.subtitle.clear();
  }
  // from millimetres of the page to points of the drawing
  const double points = kPointsPerMillimetre / setting.style.scale;
  const double width = setting.width > 0 ? setting.width : setting.style.width;
  if (width > 0) figure.width = points * width;
  // a height that was asked for is that of the figure as it stands
  if (setting.height > 0) {
    figure.height = points * setting.height;
    return figure;
  }
  // panels that would become too narrow stand one below the other
  const double head = BelowHead(figure);
  return Stacked(std::move(figure), head);
}

}  // namespace

Drawn DrawFigure(const Figure& figure, const Theme& theme) {
  // the sheet is as high as the rows of the figure need
  const Figure whole = Measured(figure);
  Sheet sheet;
  sheet.width = whole.width;
  sheet.height = whole.height;
  sheet.background = theme.background;
  Canvas canvas(sheet);
  Drawn drawn;
  Compose(canvas, whole, theme, drawn);
  drawn.image = canvas.Pixels();
  return drawn;
}

PictureFile EncodeFigure(const Figure& figure, const PageSetting& setting) {
  // the figure as the page has it, with its size in points
  const Figure page = Measured(OnPage(figure, setting));
  const Theme& theme = setting.style.theme();
  const double scale = setting.style.scale;
  // the sheet as the setting and its style ask for
  Sheet sheet{setting.format,
              page.width,
              page.height,
              scale,
              setting.dpi > 0 ? setting.dpi : setting.style.dpi,
              theme.background};
  while (true) {
    Canvas canvas(sheet);
    Drawn drawn;
    Compose(canvas, page, theme, drawn);
    // the caption says where the drawing was thinned
    const std::string caption = figure.finding + ThinningOf(drawn);
    std::string bytes = canvas.Finish({figure.title, caption});
    // vector files of long recordings tell fewer places apart until they are small enough to be sent
    const bool small = setting.format == FileFormat::png || bytes.size() <= kLargestVector;
    if (small || sheet.coarseness > kCoarsest) {
      return {std::move(bytes), caption, scale * page.width, scale * page.height};
    }
    sheet.coarseness *= kCoarser;
  }
}

}  // namespace warmjoint::report
