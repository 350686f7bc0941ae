// Words and tables for people: what their stream shows, and which words are wanted.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace warmjoint {

/// A stream as its reader sees it.
struct Page {
  int width = 80;         // columns of the terminal
  bool terminal = false;  // else a pipe or a file
  bool colour = false;
};

/// Colour needs a terminal that is not "dumb" by TERM; NO_COLOR, set and not empty, forbids it.
Page PageOf(std::FILE* stream);

enum class Colour { green, yellow, red };

/// The word in bold and colour where the page takes it, else as it is.
std::string Paint(std::string_view word, Colour colour, const Page& page);

/// From here on no progress and no notices (--quiet). Results, warnings and errors are printed as ever.
void BeQuiet();

bool IsQuiet();

/// Prints lines of which no terminal acts on a character (PrintableLines).
void PrintLines(std::FILE* stream, const std::string& lines);

/// Prints a sentence that names what came from outside.
template <typename... Args>
void Say(std::FILE* stream, fmt::format_string<Args...> format, Args&&... args) {
  PrintLines(stream, fmt::format(format, std::forward<Args>(args)...));
}

/// What is good to know and asks for nothing: on stderr, unless --quiet.
template <typename... Args>
void SayNotice(fmt::format_string<Args...> format, Args&&... args) {
  if (!IsQuiet()) Say(stderr, format, std::forward<Args>(args)...);
}

/// Cells as text: a header and rows of as many cells.
struct Table {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

/// Columns aligned with blanks: the first `left` ones to the left, the others to the right. Those that 80 columns of a terminal have no
/// room for stand in further tables below, behind the first `left` ones again.
std::string TableToText(const Table& table, size_t left);

/// The same as a Markdown table.
std::string TableToMarkdown(const Table& table, size_t left);

}  // namespace warmjoint
