#include "tools/terminal/say.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <numeric>

#include "models/foundation/excerpt.h"

namespace warmjoint {
namespace {

std::atomic<bool> quiet{false};  // progress is drawn by a thread of its own

std::string_view Variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

/// Columns that a cell takes: its characters, each of which has one byte that continues no other.
size_t Width(const std::string& cell) {
  return static_cast<size_t>(std::ranges::count_if(
      cell, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
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

/// Of columns with two blanks between.
size_t WidthOf(const std::vector<size_t>& widths, const std::vector<size_t>& columns) {
  size_t total = columns.empty() ? 0 : 2 * (columns.size() - 1);
  for (const size_t i : columns) total += widths[i];
  return total;
}

/// The columns of each table that a wide one is printed as: the first `left` ones and as many others as a page of 80 columns has room for.
std::vector<std::vector<size_t>> PartsOfPage(const std::vector<size_t>& widths, size_t left) {
  std::vector<size_t> names(std::min(left, widths.size()));
  std::iota(names.begin(), names.end(), size_t{0});
  std::vector<std::vector<size_t>> parts{names};
  for (size_t i = names.size(); i < widths.size(); ++i) {
    std::vector<size_t> more = parts.back();
    more.push_back(i);
    const bool fits = WidthOf(widths, more) <= static_cast<size_t>(Page{}.width);
    if (fits || parts.back().size() == names.size()) {
      parts.back() = std::move(more);
    } else {
      parts.push_back(names);
      parts.back().push_back(i);
    }
  }
  return parts;
}

}  // namespace

Page PageOf(std::FILE* stream) {
  Page page;
  const int file = fileno(stream);
  page.terminal = isatty(file) == 1;
  // a terminal that does not know its width has the usual one
  winsize size{};
  if (page.terminal && ioctl(file, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
    page.width = size.ws_col;
  }
  // colour only for a terminal that has it and a user who wants it
  const std::string_view kind = Variable("TERM");
  page.colour = page.terminal && !kind.empty() && kind != "dumb" && Variable("NO_COLOR").empty();
  return page;
}

std::string Paint(std::string_view word, Colour colour, const Page& page) {
  // green is good, yellow a warning, red a failure; all bold
  if (!page.colour) return std::string(word);
  const int code = colour == Colour::green ? 32 : colour == Colour::yellow ? 33 : 31;
  return fmt::format("\033[1;{}m{}\033[0m", code, word);
}

void BeQuiet() { quiet = true; }

bool IsQuiet() { return quiet; }

void PrintLines(std::FILE* stream, const std::string& lines) {
  fmt::print(stream, "{}", PrintableLines(lines));
}

std::string TableToText(const Table& given, size_t left) {
  const Table table = Shown(given);
  // as wide as the widest cell of each column
  std::vector<size_t> widths;
  for (const std::string& cell : table.header) widths.push_back(Width(cell));
  for (const auto& row : table.rows) {
    for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], Width(row[i]));
  }

  // text to the left, numbers to the right; no blanks at the end of a line
  const auto line = [&](const std::vector<std::string>& cells, const std::vector<size_t>& part) {
    std::string text;
    for (const size_t i : part) {
      const std::string blanks(widths[i] - Width(cells[i]), ' ');
      text += (i != part.front() ? "  " : "") + (i < left ? cells[i] + blanks : blanks + cells[i]);
    }
    text.erase(text.find_last_not_of(' ') + 1);
    return text + "\n";
  };

  // the header, a rule below all columns, the rows
  std::string text;
  for (const std::vector<size_t>& part : PartsOfPage(widths, left)) {
    if (!text.empty()) text += "\n";
    text += line(table.header, part) + std::string(WidthOf(widths, part), '-') + "\n";
    for (const auto& row : table.rows) text += line(row, part);
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

}  // namespace warmjoint
