// Words for people: wrapped on a terminal, one line each in a pipe or a file.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string_view>
#include <utility>

#include "tools/terminal/quiet.h"

namespace warmjoint::inline tools {

/// Prints the text, on a terminal wrapped to its width. Into a pipe or a file it goes as it is, so that
/// one message stays one line. Throws std::system_error where it cannot be written.
void SayText(std::FILE* stream, std::string_view text);

/// The same of a formatted text. Nothing that a program reads (JSON, CSV) goes this way.
template <typename... Args>
void Say(std::FILE* stream, fmt::format_string<Args...> format, Args&&... args) {
  SayText(stream, fmt::format(format, std::forward<Args>(args)...));
}

/// What is good to know and asks for nothing: on stderr, unless --quiet.
template <typename... Args>
void SayNotice(fmt::format_string<Args...> format, Args&&... args) {
  if (!IsQuiet()) SayText(stderr, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace warmjoint::inline tools
