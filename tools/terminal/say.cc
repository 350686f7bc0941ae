#include "tools/terminal/say.h"

#include "tools/terminal/page.h"
#include "tools/terminal/wrap.h"

namespace warmjoint::inline tools {

void SayText(std::FILE* stream, std::string_view text) {
  const Page page = PageOf(stream);
  fmt::print(stream, "{}", page.terminal ? Wrap(text, page.width) : std::string(text));
}

}  // namespace warmjoint::inline tools
