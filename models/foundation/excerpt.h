// What messages show of text that came from outside and may be of any length and content.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace warmjoint::inline models {

/// Characters that messages show of a value, and of what another library says of its input.
inline constexpr std::size_t kLongestValue = 60;
inline constexpr std::size_t kLongestComplaint = 240;

/// The text, or its first `longest` characters and "..." where it has more. Line ends and other
/// control characters become '?'; a character of UTF-8 stays whole.
std::string Excerpt(std::string_view text, std::size_t longest = kLongestValue);

/// "a, b, c": excerpts of all, or of the first 24 and how many more there are.
std::string ExcerptOfList(const std::vector<std::string>& texts);

}  // namespace warmjoint::inline models
