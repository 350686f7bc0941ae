#include "tools/report/draw/draw_words.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace warmjoint::report {
namespace {

constexpr double kRowStep = 1.65 * size::kTick;

constexpr double kLeastGap = 6, kWidestGap = 28;  // between columns

/// Width of each column's widest cell, points.
std::vector<double> ColumnWidths(const Table& table) {
  std::vector<double> widths(table.rows.front().size(), 0);
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    for (std::size_t column = 0; column < table.rows[row].size(); ++column) {
      const Type type{size::kTick, row == 0};
      widths[column] = std::max(widths[column], Measure(table.rows[row][column], type).width);
    }
  }
  return widths;
}

}  // namespace

double HeightOf(const Words& words, double width) {
  double height = 0;
  for (const Words::Paragraph& paragraph : words.paragraphs) {
    height += Measure(paragraph.text, {size::kText, paragraph.bold}, width).height + size::kPad;
  }
  return height;
}

double HeightOf(const Table& table) { return kRowStep * static_cast<double>(table.rows.size()); }

void DrawWords(Pen& pen, const Words& words, const Rectangle& area) {
  double y = area.top;
  for (const Words::Paragraph& paragraph : words.paragraphs) {
    const Type type{size::kText, paragraph.bold};
    y += pen.Write(paragraph.text, type, {area.left, y}, pen.theme().Colour(paragraph.hue),
                   area.width())
             .height +
         size::kPad;
  }
}

void DrawTable(Pen& pen, const Table& table, const Rectangle& area) {
  if (table.rows.empty()) return;

  // natural widths; what is left over goes between the columns, and words shrink where they must
  std::vector<double> widths = ColumnWidths(table);
  const double total = std::accumulate(widths.begin(), widths.end(), 0.0);
  const double gaps = static_cast<double>(std::max<std::size_t>(1, widths.size() - 1));
  const double shrink = std::min(1.0, area.width() / (total + kLeastGap * gaps));
  const double gap =
      std::clamp((area.width() - shrink * total) / gaps, shrink * kLeastGap, kWidestGap);

  // rows from above, the first one bold as their heading
  double y = area.top;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const Type type{shrink * size::kTick, row == 0};
    double x = area.left;
    for (std::size_t column = 0; column < table.rows[row].size(); ++column) {
      const std::string& text = table.rows[row][column];
      const double width = shrink * widths[column];
      // the first column stands at the left, numbers at the right
      const double slack = column == 0 ? 0 : width - Measure(text, type).width;
      pen.Write(text, type, {x + slack, y}, pen.theme().text);
      x += width + gap;
    }
    // a stronger line below the heading than below other rows
    y += kRowStep;
    const Rgb rule = row == 0 ? pen.theme().axis : pen.theme().grid;
    pen.canvas().Stroke({area.left, y - 2.5}, {x - gap, y - 2.5}, rule, 1);
  }
}

void DrawPicture(Pen& pen, const Picture& picture, const Rectangle& area) {
  const Image& image = picture.image;
  const double scale = std::min(area.width() / image.width, area.height() / image.height);
  const double width = scale * image.width;
  const double left = (area.left + area.right - width) / 2;
  const Rectangle place{left, area.top, left + width, area.top + scale * image.height};
  pen.canvas().Paint(image, place);
  pen.drawn().pictures.push_back(place);
}

}  // namespace warmjoint::report
