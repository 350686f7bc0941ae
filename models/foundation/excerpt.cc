#include "models/foundation/excerpt.h"

#include <fmt/format.h>

#include <algorithm>

namespace warmjoint::inline models {
namespace {

constexpr std::size_t kMostListed = 24;

/// Whether a byte goes on with the UTF-8 character that an earlier one began.
bool GoesOn(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) == 0x80; }

bool IsControl(char byte) { return static_cast<unsigned char>(byte) < 0x20 || byte == 0x7F; }

}  // namespace

std::string Excerpt(std::string_view text, std::size_t longest) {
  // the end of the first characters
  std::size_t end = 0;
  for (std::size_t characters = 0; end < text.size(); ++end) {
    if (!GoesOn(text[end]) && characters++ == longest) break;
    if (end == 4 * longest) break;  // no UTF-8
  }
  std::string excerpt(text.substr(0, end));
  std::replace_if(excerpt.begin(), excerpt.end(), IsControl, '?');
  return end < text.size() ? excerpt + "..." : excerpt;
}

std::string ExcerptOfList(const std::vector<std::string>& texts) {
  std::vector<std::string> shown;
  for (const std::string& text : texts) {
    if (shown.size() == kMostListed) break;
    shown.push_back(Excerpt(text));
  }
  const std::size_t more = texts.size() - shown.size();
  const std::string list = fmt::format("{}", fmt::join(shown, ", "));
  return more == 0 ? list : fmt::format("{} and {} more", list, more);
}

}  // namespace warmjoint::inline models
