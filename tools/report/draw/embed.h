// Files that travel inside the program.
#pragma once

/// Defines symbol_begin and symbol_end around the bytes of a file; the assembler copies them. Sources
/// that use it must be kept out of link-time optimisation, which does not see assembly.
#define WARMJOINT_EMBED(symbol, file)                          \
  asm(".section .rodata\n"                                     \
      ".balign 16\n" #symbol                                   \
      "_begin:\n"                                              \
      ".incbin \"" file "\"\n" #symbol                         \
      "_end:\n"                                                \
      ".previous\n");                                          \
  extern "C" {                                                 \
  extern const unsigned char symbol##_begin[], symbol##_end[]; \
  }
