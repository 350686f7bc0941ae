#include "models/foundation/nearest_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "models/foundation/excerpt.h"

namespace warmjoint {
namespace {

constexpr std::size_t kShortList = 60;  // characters that stand beside a suggestion
constexpr std::size_t kLongList = 120;  // and without one
constexpr std::size_t kHalf = 3;        // letters that make a beginning

/// Whether one of two words begins or ends with all of the other.
bool IsHalfOf(std::string_view a, std::string_view b) {
  if (a.size() > b.size()) std::swap(a, b);
  return a.size() >= kHalf && (b.starts_with(a) || b.ends_with(a));
}

/// As many of the names as fit, and how many more there are.
std::string ShortList(const std::vector<std::string>& known) {
  // the first name always, further ones as long as the list stays short
  std::string list;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const std::string name = Excerpt(known[i]);
    if (i > 0 && list.size() + name.size() > kLongList) {
      return fmt::format("{} and {} more", list, known.size() - i);
    }
    list += (i > 0 ? ", " : "") + name;
  }
  return list;
}

}  // namespace

int EditDistance(std::string_view a, std::string_view b) {
  // table[i][j]: distance between the first i characters of a and the first j of b
  std::vector<std::vector<int>> table(a.size() + 1, std::vector<int>(b.size() + 1));
  for (size_t i = 0; i <= a.size(); ++i) table[i][0] = static_cast<int>(i);
  for (size_t j = 0; j <= b.size(); ++j) table[0][j] = static_cast<int>(j);

  // the least of deletion, insertion and substitution, or two neighbours swapped
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
  // the nearest of those that are known
  const std::string name = Excerpt(given);

  const auto nearer = [&](const std::string& x, const std::string& y) {
    return EditDistance(name, x) < EditDistance(name, y);
  };
  const std::string& nearest = *std::min_element(known.begin(), known.end(), nearer);

  // suggest only what a slip of the fingers or a word left half explains
  const int allowed = std::max<int>(2, static_cast<int>(name.size()) / 3);
  const auto half = std::find_if(known.begin(), known.end(),
                                 [&](const std::string& one) { return IsHalfOf(name, one); });
  const bool is_near = EditDistance(name, nearest) <= allowed;
  if (!is_near && half == known.end()) return fmt::format("; known: {}", ShortList(known));
  const std::string meant = Excerpt(is_near ? nearest : *half);
  // the whole list beside it, where it is short
  const std::string all = ExcerptOfList(known);
  if (all.size() > kShortList) return fmt::format("; did you mean '{}'?", meant);
  return fmt::format("; did you mean '{}'? Known: {}", meant, all);
}

}  // namespace warmjoint
