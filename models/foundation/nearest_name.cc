#include "models/foundation/nearest_name.h"

#include <fmt/format.h>

#include <algorithm>

#include "models/foundation/excerpt.h"

namespace warmjoint::inline models {

int EditDistance(std::string_view a, std::string_view b) {
  // table[i][j]: distance between the first i characters of a and the first j of b
  std::vector<std::vector<int>> table(a.size() + 1, std::vector<int>(b.size() + 1));
  for (size_t i = 0; i <= a.size(); ++i) table[i][0] = static_cast<int>(i);
  for (size_t j = 0; j <= b.size(); ++j) table[0][j] = static_cast<int>(j);

  for (size_t i = 1; i <= a.size(); ++i) {
    for (size_t j = 1; j <= b.size(); ++j) {
      const int substitution = table[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      table[i][j] = std::min({table[i - 1][j] + 1, table[i][j - 1] + 1, substitution});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) table[i][j] = std::min(table[i][j], table[i - 2][j - 2] + 1);
    }
  }
  return table[a.size()][b.size()];
}

std::string Suggestion(std::string_view given, const std::vector<std::string>& known) {
  if (known.empty()) return "";
  const std::string name = Excerpt(given);

  const auto nearer = [&](const std::string& x, const std::string& y) {
    return EditDistance(name, x) < EditDistance(name, y);
  };
  const std::string& nearest = *std::min_element(known.begin(), known.end(), nearer);

  // suggest only what a slip of the fingers explains
  const int allowed = std::max<int>(2, static_cast<int>(name.size()) / 3);
  const std::string known_names = ExcerptOfList(known);
  if (EditDistance(name, nearest) > allowed) return fmt::format("; known: {}", known_names);
  return fmt::format("; did you mean '{}'? Known: {}", Excerpt(nearest), known_names);
}

}  // namespace warmjoint::inline models
