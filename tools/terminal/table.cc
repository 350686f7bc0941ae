#include "tools/terminal/table.h"

#include <fmt/format.h>

#include <algorithm>

#include "models/foundation/excerpt.h"
#include "tools/terminal/wrap.h"

namespace warmjoint::inline tools {
namespace {

constexpr size_t kBetween = 2;     // blanks between columns
constexpr size_t kNarrowest = 16;  // columns that broken words need at least

size_t Width(const std::string& text) { return static_cast<size_t>(ShownWidth(text)); }

std::vector<size_t> Widths(const Table& table) {
  // as wide as the widest cell of each column
  std::vector<size_t> widths;
  for (const std::string& cell : table.header) widths.push_back(Width(cell));
  for (const auto& row : table.rows) {
    for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], Width(row[i]));
  }
  return widths;
}

std::string Line(const std::vector<std::string>& cells, const std::vector<size_t>& widths,
                 size_t left) {
  std::string line;
  // text to the left, numbers to the right; no blanks at the end of a line
  for (size_t i = 0; i < cells.size(); ++i) {
    const std::string blanks(widths[i] - Width(cells[i]), ' ');
    line += i < left ? cells[i] + blanks : blanks + cells[i];
    line += "  ";
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

size_t Total(const std::vector<size_t>& widths) {
  size_t total = widths.empty() ? 0 : kBetween * (widths.size() - 1);
  for (const size_t width : widths) total += width;
  return total;
}

std::string Aligned(const Table& table, size_t left) {
  const std::vector<size_t> widths = Widths(table);
  std::string text = Line(table.header, widths, left);
  text += std::string(Total(widths), '-') + "\n";
  for (const auto& row : table.rows) text += Line(row, widths, left);
  return text;
}

/// The table with its last column in lines that end at `room`.
Table WithBrokenWords(const Table& table, const std::vector<size_t>& widths, size_t room) {
  // the last column takes the width that the others leave
  const size_t before = Total(widths) - widths.back();
  const size_t rest = std::max(kNarrowest, room - std::min(room, before));
  Table broken{table.header, {}};
  for (std::vector<std::string> row : table.rows) {
    // further lines of a cell stand alone in their rows
    for (std::string& line : WrapLine(row.back(), static_cast<int>(rest))) {
      row.back() = std::move(line);
      broken.rows.push_back(row);
      std::fill(row.begin(), row.end(), "");
    }
  }
  return broken;
}

/// The first `left` columns and those from `begin` to before `end`.
Table Block(const Table& table, size_t left, size_t begin, size_t end) {
  const auto cut = [&](const std::vector<std::string>& cells) {
    std::vector<std::string> some(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(left));
    some.insert(some.end(), cells.begin() + static_cast<std::ptrdiff_t>(begin),
                cells.begin() + static_cast<std::ptrdiff_t>(end));
    return some;
  };
  Table block{cut(table.header), {}};
  for (const auto& row : table.rows) block.rows.push_back(cut(row));
  return block;
}

/// The table with cells that no terminal acts on.
Table Shown(Table table) {
  for (std::string& cell : table.header) cell = Printable(cell);
  for (auto& row : table.rows) {
    for (std::string& cell : row) cell = Printable(cell);
  }
  return table;
}

std::string MarkdownLine(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) {
    std::string escaped;
    for (const char c : cell) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
    line += fmt::format(" {} |", escaped);
  }
  return line + "\n";
}

}  // namespace

std::string TableToText(const Table& given, size_t left, int width) {
  const Table table = Shown(given);
  const size_t room = static_cast<size_t>(std::max(width, 0));
  const std::vector<size_t> widths = Widths(table);
  if (Total(widths) <= room) return Aligned(table, left);
  if (left >= table.header.size()) return Aligned(WithBrokenWords(table, widths, room), left);

  // blocks of as many columns of numbers as fit behind the first ones
  std::string text;
  const size_t named = Total({widths.begin(), widths.begin() + static_cast<std::ptrdiff_t>(left)});
  for (size_t begin = left, end = left; begin < widths.size(); begin = end) {
    // at least one column goes in, however wide it is
    size_t used = named;
    while (end < widths.size() && (end == begin || used + kBetween + widths[end] <= room)) {
      used += kBetween + widths[end++];
    }
    if (begin > left) text += "\n";
    text += Aligned(Block(table, left, begin, end), left);
  }
  return text;
}

std::string TableToMarkdown(const Table& given, size_t left) {
  const Table table = Shown(given);
  // a colon at the right stands for a column of numbers
  std::string text = MarkdownLine(table.header) + "|";
  for (size_t i = 0; i < table.header.size(); ++i) text += i < left ? " --- |" : " ---: |";
  text += "\n";
  for (const auto& row : table.rows) text += MarkdownLine(row);
  return text;
}

}  // namespace warmjoint::inline tools
