#include "tools/terminal/page.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>

#include "models/foundation/parse_number.h"

namespace warmjoint::inline tools {
namespace {

constexpr int kNarrowest = 20, kWidest = 1000;  // columns

bool IsWidth(long columns) { return kNarrowest <= columns && columns <= kWidest; }

std::string_view Variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

int WidthOf(int file, bool terminal) {
  // what the user says, then what the terminal says, then the default
  const auto columns = ParseInteger(Variable("COLUMNS"));
  if (columns && IsWidth(static_cast<long>(*columns))) return static_cast<int>(*columns);
  winsize size{};
  if (terminal && ioctl(file, TIOCGWINSZ, &size) == 0 && IsWidth(size.ws_col)) return size.ws_col;
  return Page{}.width;
}

}  // namespace

Page PageOf(std::FILE* stream) {
  // colour only for a terminal that has it and a user who wants it
  const int file = fileno(stream);
  const bool terminal = isatty(file) == 1;
  const std::string_view kind = Variable("TERM");
  const bool colour = terminal && !kind.empty() && kind != "dumb" && Variable("NO_COLOR").empty();
  return {WidthOf(file, terminal), terminal, colour};
}

std::string Paint(std::string_view word, Colour colour, const Page& page) {
  // green is good, yellow a warning, red a failure; all bold
  if (!page.colour) return std::string(word);
  const int code = colour == Colour::green ? 32 : colour == Colour::yellow ? 33 : 31;
  return fmt::format("\033[1;{}m{}\033[0m", code, word);
}

}  // namespace warmjoint::inline tools
