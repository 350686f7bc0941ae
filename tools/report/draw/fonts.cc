#include "tools/report/draw/fonts.h"

#include "tools/report/draw/embed.h"

WARMJOINT_EMBED(warmjoint_font_regular, WARMJOINT_FONT)
WARMJOINT_EMBED(warmjoint_font_bold, WARMJOINT_FONT_BOLD)

namespace warmjoint::report {

std::span<const unsigned char> RegularFont() {
  return {warmjoint_font_regular_begin, warmjoint_font_regular_end};
}

std::span<const unsigned char> BoldFont() {
  return {warmjoint_font_bold_begin, warmjoint_font_bold_end};
}

}  // namespace warmjoint::report
