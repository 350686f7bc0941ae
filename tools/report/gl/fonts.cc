#include "tools/report/gl/fonts.h"

// the assembler copies the files into the program
#define WARMJOINT_EMBED(name, file) \
  asm(".section .rodata\n"          \
      ".balign 16\n" name           \
      "_begin:\n"                   \
      ".incbin \"" file "\"\n" name \
      "_end:\n"                     \
      ".previous\n")
WARMJOINT_EMBED("warmjoint_font_regular", WARMJOINT_FONT);
WARMJOINT_EMBED("warmjoint_font_bold", WARMJOINT_FONT_BOLD);

extern "C" {
extern const unsigned char warmjoint_font_regular_begin[], warmjoint_font_regular_end[];
extern const unsigned char warmjoint_font_bold_begin[], warmjoint_font_bold_end[];
}

namespace warmjoint::report {

std::span<const unsigned char> RegularFont() {
  return {warmjoint_font_regular_begin, warmjoint_font_regular_end};
}

std::span<const unsigned char> BoldFont() {
  return {warmjoint_font_bold_begin, warmjoint_font_bold_end};
}

}  // namespace warmjoint::report
