// Suggestions for mistyped names: "unknown key 'speds'; did you mean 'speeds'?"
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace warmjoint {

/// Number of single-character insertions, deletions, substitutions and swaps of neighbours
/// between two words (optimal string alignment distance).
int EditDistance(std::string_view a, std::string_view b);

/// A sentence that ends a refusal of `name`: "; did you mean 'x'? Known: a, b, c", where x is the
/// nearest of `known`: its beginning or its end of three letters or more, or a slip of the fingers away (distance
/// of at most a third of the length). Without such a name: "; known: a, b, c". A list that is long is left out
/// beside a nearest name, and shortened without one.
std::string Suggestion(std::string_view name, const std::vector<std::string>& known);

}  // namespace warmjoint
