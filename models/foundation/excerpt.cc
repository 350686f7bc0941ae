#include "models/foundation/excerpt.h"

#include <fmt/format.h>

#include <algorithm>

#include "models/foundation/printable.h"
#include "models/foundation/utf8.h"

namespace warmjoint::inline models {
namespace {

constexpr std::size_t kMostListed = 24;

}  // namespace

std::string Excerpt(std::string_view text, std::size_t longest) {
  // the end of the first characters; a byte that is no UTF-8 counts as one
  std::size_t end = 0;
  for (std::size_t characters = 0; end < text.size() && characters < longest; ++characters) {
    end += std::max<std::size_t>(1, FirstCharacter(text.substr(end)).length);
  }
  const std::string excerpt = Printable(text.substr(0, end));
  return end < text.size() ? excerpt + "..." : excerpt;
}

std::string ExcerptOfList(const std::vector<std::string>& texts) {
  std::vector<std::string> shown;
  for (const std::string& text : texts) {
    if (shown.size() == kMostListed) break;
    shown.push_back(Excerpt(text));
  }
  // how many are not shown
  const std::size_t more = texts.size() - shown.size();
  const std::string list = fmt::format("{}", fmt::join(shown, ", "));
  return more == 0 ? list : fmt::format("{} and {} more", list, more);
}

}  // namespace warmjoint::inline models
