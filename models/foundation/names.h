// Names that come from outside: of joints, links, columns and files. They are text, and are checked where they enter.
#pragma once

#include <string_view>

#include "models/foundation/bad_input.h"

namespace warmjoint {

/// Throws BadInput from `place` for a name that is no text: with bytes that are no UTF-8, or with a character on which a terminal,
/// an XML parser or a line of a program acts (Printable in excerpt.h), or longer than 200 bytes. what: "the name of a joint".
void RequireName(std::string_view what, std::string_view name, const Place& place);

/// The same of a text that may have several lines and marks of writing direction: refused are bytes that are no UTF-8, and the
/// control characters C0, DEL and C1 but for tabs and line ends.
void RequireText(std::string_view what, std::string_view text, const Place& place);

}  // namespace warmjoint
