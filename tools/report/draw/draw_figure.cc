#include "tools/report/draw/draw_figure.h"

#include "tools/report/draw/draw_plot.h"
#include "tools/report/draw/draw_words.h"
#include "tools/report/draw/layout.h"
#include "tools/report/draw/pen.h"

namespace warmjoint::report {
namespace {

/// Title and subtitle of the figure; returns y below them.
float DrawHead(Pen& pen, const Figure& figure) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float width = static_cast<float>(figure.width) - 2 * size::kMargin;
  float y = size::kMargin - 4;
  if (!figure.title.empty()) {
    y += pen.Write(list, figure.title, {size::kTitle, true}, {size::kMargin, y}, pen.theme().text,
                   width)
             .y +
         2;
  }
  if (!figure.subtitle.empty()) {
    y += pen.Write(list, figure.subtitle, {size::kText}, {size::kMargin, y}, pen.theme().faint_text,
                   width)
             .y;
  }
  return y + 12;
}

void DrawPanel(Pen& pen, const Panel& panel, const PanelPlace& place, int number) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto* plot = std::get_if<Plot>(&panel.content);
  // titles and legends start with the axis, or with the cell where the legend is long
  float left = place.area.left;
  if (plot && LegendHeight(pen, *plot, place.cell.right - left) >
                  LegendHeight(pen, *plot, place.cell.width())) {
    left = place.cell.left;
  }
  float y = place.cell.top;
  if (!panel.title.empty()) {
    y += pen.Write(list, panel.title, {size::kText, true}, {left, y}, pen.theme().text).y + 4;
  }
  if (plot) {
    DrawLegend(pen, *plot, {left, y}, place.cell.right - left);
    DrawPlot(pen, panel.title, *plot, place.area, place.cell.left + size::kText / 2 + 2, number);
  } else if (const auto* words = std::get_if<Words>(&panel.content)) {
    DrawWords(pen, *words, place.area);
  } else if (const auto* table = std::get_if<Table>(&panel.content)) {
    DrawTable(pen, *table, place.area);
  } else if (const auto* picture = std::get_if<Picture>(&panel.content)) {
    DrawPicture(pen, *picture, place.area);
  }
}

/// Pictures go into the finished pixels.
void PastePictures(const Figure& figure, Drawn& drawn) {
  auto place = drawn.pictures.begin();
  for (const Panel& panel : figure.panels) {
    const auto* picture = std::get_if<Picture>(&panel.content);
    if (!picture) continue;
    const auto pixel = [](float points) {
      return static_cast<int>(points * Canvas::kPixelsPerPoint + 0.5f);
    };
    Paste(picture->image, pixel(place->left), pixel(place->top), pixel(place->width()),
          pixel(place->height()), drawn.image);
    ++place;
  }
}

}  // namespace

Drawn DrawFigure(Canvas& canvas, const Figure& figure, const Theme& theme) {
  // refuse before anything is drawn
  for (const Panel& panel : figure.panels) {
    if (const auto* plot = std::get_if<Plot>(&panel.content)) CheckAxes(*plot);
  }

  Drawn drawn;
  drawn.image = canvas.Draw(figure.width, figure.height, theme.background, [&](const Brush& brush) {
    // every frame draws it all: keep the record of the last
    drawn = {};
    Pen pen(brush, theme, drawn);
    const float top = DrawHead(pen, figure);
    const std::vector<PanelPlace> places = LayOut(pen, figure, top);
    for (std::size_t i = 0; i < places.size(); ++i) {
      DrawPanel(pen, figure.panels[i], places[i], static_cast<int>(i));
    }
  });
  PastePictures(figure, drawn);
  return drawn;
}

}  // namespace warmjoint::report
