// Text from outside that goes to a terminal.
#pragma once

#include <string>
#include <string_view>

namespace warmjoint::inline models {

/// The text on one line that no terminal acts on: control characters (C0, DEL, C1), marks of writing
/// direction and line separators become their codes, as \x1B and \u202E; so do bytes that are no
/// UTF-8, as \xCF.
std::string Printable(std::string_view text);

/// The same of each line of a text that keeps its line ends.
std::string PrintableLines(std::string_view text);

}  // namespace warmjoint::inline models
