#include "tools/board/table.h"

#include <fmt/format.h>

#include <algorithm>

namespace warmjoint::inline tools {
namespace {

/// Number of characters that a UTF-8 text shows.
size_t Width(const std::string& text) {
  return static_cast<size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::vector<size_t> Widths(const Table& table) {
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
  for (size_t i = 0; i < cells.size(); ++i) {
    const std::string blanks(widths[i] - Width(cells[i]), ' ');
    line += i < left ? cells[i] + blanks : blanks + cells[i];
    line += "  ";
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
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

std::string TableToText(const Table& table, size_t left) {
  const std::vector<size_t> widths = Widths(table);
  std::string text = Line(table.header, widths, left);
  size_t total = 0;
  for (const size_t width : widths) total += width + 2;
  text += std::string(total - 2, '-') + "\n";
  for (const auto& row : table.rows) text += Line(row, widths, left);
  return text;
}

std::string TableToMarkdown(const Table& table, size_t left) {
  std::string text = MarkdownLine(table.header) + "|";
  for (size_t i = 0; i < table.header.size(); ++i) text += i < left ? " --- |" : " ---: |";
  text += "\n";
  for (const auto& row : table.rows) text += MarkdownLine(row);
  return text;
}

}  // namespace warmjoint::inline tools
