#include "tools/terminal/say.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <numeric>
#include <sstream>

#include "models/foundation/excerpt.h"

namespace warmjoint {
namespace {

std::atomic<bool> quiet{false};  // progress is drawn by a thread of its own

std::string_view Variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

/// Columns that a text takes: its characters, each of which has one byte that continues no other, without the colours of Paint.
size_t Width(std::string_view text) {
  size_t width = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\033') {
      i = std::min(text.find('m', i), text.size() - 1);
      continue;
    }
    width += (static_cast<unsigned char>(text[i]) & 0xC0) != 0x80;
  }
  return width;
}

/// Where the text of a line begins: behind leading blanks, a bullet, or a name with two blanks or more after it. A text that would begin in
/// the right half of `width` columns begins behind the leading blanks.
size_t BeginOfText(std::string_view line, size_t width) {
  const size_t first = std::min(line.find_first_not_of(' '), line.size());
  if (line.substr(first).starts_with("* ")) return first + 2;
  const size_t gap = line.find("  ", first);
  const size_t begin = gap == std::string_view::npos ? gap : line.find_first_not_of(' ', gap);
  return begin < width / 2 ? begin : first;
}

/// One line, broken at blanks.
std::string WrappedLine(std::string_view line, size_t width) {
  if (Width(line) <= width) return std::string(line);
  const size_t begin = BeginOfText(line, width);
  std::string text(line.substr(0, begin));
  const std::string indent(Width(text), ' ');
  size_t at = indent.size();
  line.remove_prefix(begin);
  // word by word, each with the blanks before it
  while (!line.empty()) {
    const size_t word = std::min(line.find_first_not_of(' '), line.size());
    const size_t end = std::min(line.find(' ', word), line.size());
    const size_t wide = Width(line.substr(0, end));
    if (at > indent.size() && at + wide > width && word < end) {
      text += "\n" + indent;
      at = indent.size();
      line.remove_prefix(word);
      continue;
    }
    text += line.substr(0, end);
    at += wide;
    line.remove_prefix(end);
  }
  return text;
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

/// The columns of each table that a wide one is printed as: the first `left` ones and as many others as a page has room for.
std::vector<std::vector<size_t>> PartsOfPage(const std::vector<size_t>& widths, size_t left,
                                             const Page& page) {
  std::vector<size_t> names(std::min(left, widths.size()));
  std::iota(names.begin(), names.end(), size_t{0});
  std::vector<std::vector<size_t>> parts{names};
  for (size_t i = names.size(); i < widths.size(); ++i) {
    std::vector<size_t> more = parts.back();
    more.push_back(i);
    const bool fits = WidthOf(widths, more) <= static_cast<size_t>(page.width);
    if (fits || parts.back().size() == names.size()) {
      parts.back() = std::move(more);
    } else {
      parts.push_back(names);
      parts.back().push_back(i);
    }
  }
  return parts;
}

/// The widths with that of the part's widest column as small as the page asks for, but no less than its heading or a word may need.
std::vector<size_t> Fitting(std::vector<size_t> widths, const std::vector<size_t>& part,
                            const Page& page) {
  constexpr size_t kNarrowest = 20;
  const size_t all = WidthOf(widths, part), room = static_cast<size_t>(page.width);
  if (part.empty() || all <= room) return widths;
  size_t& widest = widths[std::ranges::max(part, {}, [&](size_t i) { return widths[i]; })];
  const size_t others = all - widest;
  widest = std::min(widest, std::max(kNarrowest, room - std::min(room, others)));
  return widths;
}

/// A row: text to the left, numbers to the right, cells that are wider than their column broken at blanks; no blanks at the end of a line.
std::string RowOfTable(const std::vector<std::string>& cells, const std::vector<size_t>& part,
                       size_t left, const std::vector<size_t>& widths) {
  // the lines of each cell
  std::vector<std::vector<std::string>> broken(cells.size());
  size_t lines = 1;
  for (const size_t i : part) {
    std::istringstream words(Wrapped(cells[i], widths[i]));
    for (std::string line; std::getline(words, line);) broken[i].push_back(line);
    lines = std::max(lines, broken[i].size());
  }

  std::string text;
  for (size_t k = 0; k < lines; ++k) {
    for (const size_t i : part) {
      const std::string cell = k < broken[i].size() ? broken[i][k] : "";
      const std::string blanks(widths[i] - std::min(widths[i], Width(cell)), ' ');
      text += (i != part.front() ? "  " : "") + (i < left ? cell + blanks : blanks + cell);
    }
    text.erase(text.find_last_not_of(' ') + 1);
    text += "\n";
  }
  return text;
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

std::string Wrapped(std::string_view text, size_t width) {
  std::string wrapped;
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    wrapped += WrappedLine(text.substr(0, end), width);
    if (end < text.size()) wrapped += '\n';
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return wrapped;
}

void SayText(std::FILE* stream, const std::string& text) {
  const Page page = PageOf(stream);
  const std::string shown = page.terminal ? Wrapped(text, static_cast<size_t>(page.width)) : text;
  // whether it was written is asked once, at the end of the program
  std::fwrite(shown.data(), 1, shown.size(), stream);
}

void SayLines(std::FILE* stream, const std::string& lines) {
  SayText(stream, PrintableLines(lines));
}

std::string TableToText(const Table& given, size_t left, const Page& page) {
  const Table table = Shown(given);
  // as wide as the widest cell of each column
  std::vector<size_t> widths;
  for (const std::string& cell : table.header) widths.push_back(Width(cell));
  for (const auto& row : table.rows) {
    for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], Width(row[i]));
  }

  // the header, a rule below all columns, the rows
  std::string text;
  for (const std::vector<size_t>& part : PartsOfPage(widths, left, page)) {
    const std::vector<size_t> fitting = Fitting(widths, part, page);
    if (!text.empty()) text += "\n";
    text += RowOfTable(table.header, part, left, fitting) +
            std::string(WidthOf(fitting, part), '-') + "\n";
    for (const auto& row : table.rows) text += RowOfTable(row, part, left, fitting);
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
