#include "models/recording/time_names.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <string_view>
#include <utility>

#include "models/foundation/excerpt.h"
#include "models/recording/units.h"

namespace warmjoint {
namespace {

bool IsSign(char c) { return std::ispunct(static_cast<unsigned char>(c)) || c == ' '; }

/// Without signs and blanks around it.
std::string_view Bare(std::string_view text) {
  while (!text.empty() && IsSign(text.front())) text.remove_prefix(1);
  while (!text.empty() && IsSign(text.back())) text.remove_suffix(1);
  return text;
}

/// A name in small letters, in two at its last dot, stroke or colon: "header.stamp" and "sec".
std::pair<std::string, std::string> PathAndLast(const std::string& name) {
  const std::string lower = Lowercase(Bare(name));
  const std::size_t at = lower.find_last_of("./:") + 1;
  return {lower.substr(0, at), std::string(Bare(std::string_view(lower).substr(at)))};
}

/// A name in two at its last word: "stamp_" and "nanosec".
std::pair<std::string, std::string> StemAndWord(const std::string& name) {
  const std::string lower = Lowercase(Bare(name));
  const auto is_letter = [](unsigned char c) { return std::isalpha(c) != 0; };
  const auto begin = std::find_if_not(lower.rbegin(), lower.rend(), is_letter).base();
  return {std::string(lower.begin(), begin), std::string(begin, lower.end())};
}

/// The one of `names` that `fits`; nothing where none or several do.
template <typename Fits>
std::optional<std::size_t> OnlyOne(const std::vector<std::string>& names, Fits&& fits) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!fits(names[i])) continue;
    if (found) return std::nullopt;
    found = i;
  }
  return found;
}

/// Whether a word counts seconds, and whether it counts a part of them. A letter alone may be the unit of one of two whole times.
bool IsSeconds(const std::string& word) {
  const auto unit = MeantUnit(word, {"s"});
  return word.size() > 2 && unit && unit->factor == 1;
}
bool IsPart(const std::string& word) {
  const auto unit = MeantUnit(word, {"s"});
  // why: a column of ms beside one of s is the same time again; clocks of systems count s and us or ns
  return word.size() > 2 && unit && unit->factor <= 1e-6;
}

}  // namespace

std::vector<std::size_t> FindTime(const std::vector<std::string>& names,
                                  const std::vector<std::string>& words) {
  const auto stem_of = [](const std::string& name) { return SplitUnit(name, {"s"}).stem; };
  for (const std::string& word : words) {
    // the name as it is, then without what is around it, then the end of a path
    const auto exact = std::ranges::find(names, word);
    if (exact != names.end()) return {static_cast<std::size_t>(exact - names.begin())};
    const auto whole = OnlyOne(names, [&](const std::string& name) {
      return Lowercase(Bare(name)) == word || Lowercase(Bare(stem_of(name))) == word;
    });
    if (whole) return {*whole};
    const auto last = OnlyOne(
        names, [&](const std::string& name) { return PathAndLast(stem_of(name)).second == word; });
    if (last) return {*last};
  }
  // seconds and what is to be added to them, of one stamp
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto [stem, word] = StemAndWord(names[i]);
    if (!IsSeconds(word)) continue;
    const auto part = OnlyOne(names, [&, &stem = stem](const std::string& name) {
      const auto other = StemAndWord(name);
      return other.first == stem && IsPart(other.second);
    });
    if (!part) continue;
    if (!found.empty()) return {};
    found = {i, *part};
  }
  return found;
}

std::string UnitOfPart(const std::string& name) { return StemAndWord(name).second; }

}  // namespace warmjoint
