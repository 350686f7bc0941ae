// Text from outside: its characters of UTF-8, what messages and terminals show of it, and which name a mistyped one means.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace warmjoint {

/// A character: its code and its number of bytes; 0 bytes for what is no UTF-8.
struct Character {
  char32_t code = 0;
  std::size_t length = 0;
};

/// The first character of a text that is not empty.
Character FirstCharacter(std::string_view text);

/// Position of the first byte that is no UTF-8, or of a zero byte.
std::optional<std::size_t> FirstBrokenByte(std::string_view text);

/// The text on one line that no terminal acts on: control characters (C0, DEL, C1), marks of writing
/// direction and line separators become their codes, as \x1B and \u202E; so do bytes that are no
/// UTF-8, as \xCF.
std::string Printable(std::string_view text);

/// The same of each line of a text that keeps its line ends.
std::string PrintableLines(std::string_view text);

/// Characters that messages show of a value, and of what another library says of its input.
inline constexpr std::size_t kLongestValue = 60;
inline constexpr std::size_t kLongestComplaint = 240;

/// The text, or its first `longest` characters and "..." where it has more. Line ends and other
/// control characters become '?'; a character of UTF-8 stays whole.
std::string Excerpt(std::string_view text, std::size_t longest = kLongestValue);

/// "a, b, c": excerpts of all, or of the first 24 and how many more there are.
std::string ExcerptOfList(const std::vector<std::string>& texts);

/// The text without blanks and line ends around it.
std::string_view Trimmed(std::string_view text);

/// The text in small letters. ASCII alone: other characters stay as they are.
std::string Lowercase(std::string_view text);

/// Whether two texts differ in nothing but the case of their letters in ASCII.
bool EqualIgnoringCase(std::string_view a, std::string_view b);

/// Number of single-character insertions, deletions, substitutions and swaps of neighbours
/// between two words (optimal string alignment distance).
int EditDistance(std::string_view a, std::string_view b);

/// A sentence that ends a refusal of `name`: "; did you mean 'x'? Known: a, b, c", where x is the
/// nearest of `known`: its beginning or its end of three letters or more, or a slip of the fingers away (distance
/// of at most a third of the length). Without such a name: "; known: a, b, c". A list that is long is left out
/// beside a nearest name, and shortened without one.
std::string Suggestion(std::string_view name, const std::vector<std::string>& known);

}  // namespace warmjoint
