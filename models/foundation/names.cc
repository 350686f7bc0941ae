#include "models/foundation/names.h"

#include <string>

#include "models/foundation/excerpt.h"

namespace warmjoint {
namespace {

constexpr std::size_t kLongest = 200;  // bytes of a name; why: a picture's title holds no more

/// Refuses the first character that is not shown as it is, and for which `allowed` says no.
template <typename Allowed>
void Require(std::string_view what, std::string_view text, const Place& place, Allowed allowed) {
  for (std::size_t at = 0; at < text.size();) {
    // most of a text is this, and long ones are read
    if (' ' <= text[at] && text[at] <= '~') {
      ++at;
      continue;
    }
    const Character character = FirstCharacter(text.substr(at));
    if (character.length == 0) {
      Refuse(place, "{} '{}' is no UTF-8 at its byte {}; write it in UTF-8", what, Excerpt(text),
             at + 1);
    }
    const std::string_view bytes = text.substr(at, character.length);
    if (const std::string shown = Printable(bytes); shown != bytes && !allowed(character.code)) {
      Refuse(place, "{} '{}' has the control character {} at its byte {}; take it out", what,
             Excerpt(text), shown, at + 1);
    }
    at += character.length;
  }
}

}  // namespace

void RequireName(std::string_view what, std::string_view name, const Place& place) {
  if (name.size() > kLongest) {
    Refuse(place, "{} '{}' has {} bytes; at most {} are read", what, Excerpt(name), name.size(),
           kLongest);
  }
  Require(what, name, place, [](char32_t) { return false; });
}

void RequireText(std::string_view what, std::string_view text, const Place& place) {
  constexpr char32_t first_letter = 0xA0;  // behind the second set of control characters
  Require(what, text, place, [](char32_t code) {
    return code == '\t' || code == '\n' || code == '\r' || code >= first_letter;
  });
}

}  // namespace warmjoint
