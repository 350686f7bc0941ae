#include "tools/report/draw/draw_words.h"

#include <algorithm>
#include <vector>

namespace warmjoint::report {

void DrawWords(Pen& pen, const Words& words, const Rectangle& area) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  float y = area.top;
  for (const Words::Paragraph& paragraph : words.paragraphs) {
    const Type type{size::kText, paragraph.bold};
    y += pen.Write(list, paragraph.text, type, {area.left, y}, pen.theme().Colour(paragraph.hue),
                   area.width())
             .y +
         size::kPad;
  }
}

void DrawTable(Pen& pen, const Table& table, const Rectangle& area) {
  if (table.rows.empty()) return;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto type_of = [](std::size_t row) { return Type{size::kTick, row == 0}; };

  // natural widths; what is left over goes between the columns
  std::vector<float> widths(table.rows.front().size(), 0);
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    for (std::size_t column = 0; column < table.rows[row].size(); ++column) {
      const float width = pen.Measure(table.rows[row][column], type_of(row)).x;
      widths[column] = std::max(widths[column], width);
    }
  }
  float total = 0;
  for (float width : widths) total += width;
  const float spare =
      (area.width() - total) / static_cast<float>(std::max<std::size_t>(1, widths.size() - 1));
  const float gap = std::clamp(spare, 6.0f, 28.0f);

  float y = area.top;
  const float step = size::kTick * 1.65f;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    float x = area.left;
    for (std::size_t column = 0; column < table.rows[row].size(); ++column) {
      const std::string& text = table.rows[row][column];
      const float slack = column == 0 ? 0 : widths[column] - pen.Measure(text, type_of(row)).x;
      pen.Write(list, text, type_of(row), {x + slack, y}, pen.theme().text);
      x += widths[column] + gap;
    }
    y += step;
    const Rgb rule = row == 0 ? pen.theme().axis : pen.theme().grid;
    list.AddLine({area.left, y - 2}, {x - gap, y - 2}, Pen::Paint(rule), 1);
  }
}

void DrawPicture(Pen& pen, const Picture& picture, const Rectangle& area) {
  const Image& image = picture.image;
  const float scale = std::min(area.width() / static_cast<float>(image.width),
                               area.height() / static_cast<float>(image.height));
  const ImVec2 extent{scale * static_cast<float>(image.width),
                      scale * static_cast<float>(image.height)};
  const float left = (area.left + area.right - extent.x) / 2;
  pen.drawn().pictures.push_back({left, area.top, left + extent.x, area.top + extent.y});
}

}  // namespace warmjoint::report
