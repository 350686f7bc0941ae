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

/// The text with each line of more than `width` columns broken at blanks; a word that is longer stays whole. What follows begins below the
/// text of the line: behind its leading blanks, a bullet "* ", or a name with two blanks or more after it.
std::string Wrapped(std::string_view text, size_t width);

/// Prints words for people, which may be painted. On a terminal no line is wider than it (Wrapped); a pipe and a file get lines as they
/// are.
void SayText(std::FILE* stream, const std::string& text);

/// The same of lines of which no terminal acts on a character (PrintableLines).
void SayLines(std::FILE* stream, const std::string& lines);

/// The same of a sentence.
template <typename... Args>
void Say(std::FILE* stream, fmt::format_string<Args...> format, Args&&... args) {
  SayLines(stream, fmt::format(format, std::forward<Args>(args)...));
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

/// Columns aligned with blanks: the first `left` ones to the left, the others to the right. Those that the page has no room for stand in
/// further tables below, after the first `left` ones again; where these alone are wider, the widest column is broken at blanks.
std::string TableToText(const Table& table, size_t left, const Page& page = {});

/// The same as a Markdown table.
std::string TableToMarkdown(const Table& table, size_t left);

}  // namespace warmjoint
