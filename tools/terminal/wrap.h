// Text laid out for a width.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace warmjoint::inline tools {

/// Columns that a text of UTF-8 takes; escape sequences of colours take none.
int ShownWidth(std::string_view text);

/// The text broken at blanks into lines of at most `width` columns. A longer word stands alone on its
/// line. Blanks at the beginning of the text stay.
std::vector<std::string> WrapLine(std::string_view text, int width);

/// Every line of `text` that is wider than `width` broken at blanks; what is left of it begins as far
/// to the right as the line does, and `hanging` columns more. Other lines stay as they are.
std::string Wrap(std::string_view text, int width, int hanging = 2);

/// The lines of a text without their ends.
std::vector<std::string> Lines(std::string_view text);

/// The first `width` columns; where there are more, the last three of them are "...".
std::string CutToWidth(std::string_view text, int width);

}  // namespace warmjoint::inline tools
