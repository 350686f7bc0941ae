// What a stream can show: its width, and whether words may be coloured.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace warmjoint::inline tools {

/// A stream as its reader sees it.
struct Page {
  int width = 80;         // columns
  bool terminal = false;  // else a pipe or a file
  bool colour = false;
};

/// The width is that of the environment's COLUMNS (20 to 1000), else of the terminal, else 80. Colour
/// needs a terminal that is not "dumb" by TERM; NO_COLOR, set and not empty, forbids it.
Page PageOf(std::FILE* stream);

enum class Colour { green, yellow, red };

/// The word in bold and colour where the page takes it, else as it is.
std::string Paint(std::string_view word, Colour colour, const Page& page);

}  // namespace warmjoint::inline tools
