#include "tools/terminal/say.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>

namespace warmjoint {
namespace {

std::atomic<bool> quiet{false};  // progress is drawn by a thread of its own

std::string_view Variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
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

}  // namespace warmjoint
