#include "models/foundation/xml_tags.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "models/foundation/excerpt.h"

namespace warmjoint {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

/// Size up to and with `end`; all of the text where it is absent.
std::size_t Through(std::string_view text, std::string_view end) {
  const std::size_t at = text.find(end);
  return at == std::string_view::npos ? text.size() : at + end.size();
}

/// Size of the tag at the front: a > within quotes does not end it.
std::size_t SizeOfTag(std::string_view text) {
  // a quote ends at another of its kind
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (quote == 0 && text[i] == '>') return i + 1;
    if (quote == 0 && (text[i] == '"' || text[i] == '\'')) {
      quote = text[i];
    } else if (text[i] == quote) {
      quote = 0;
    }
  }
  return text.size();
}

XmlTag Parsed(std::string_view tag, int line) {
  XmlTag parsed;
  parsed.line = line;
  // without brackets, and by its slash, where it has one
  tag.remove_prefix(1);
  if (tag.ends_with('>')) tag.remove_suffix(1);
  if (tag.starts_with('/')) {
    parsed.kind = XmlTag::Kind::closes;
    tag.remove_prefix(1);
  } else if (tag.ends_with('/')) {
    parsed.kind = XmlTag::Kind::stands_alone;
    tag.remove_suffix(1);
  }
  const std::size_t end = std::min(tag.find_first_of(kBlanks), tag.size());
  parsed.name = tag.substr(0, end);
  parsed.attributes = tag.substr(end);
  return parsed;
}

}  // namespace

std::vector<XmlAttribute> XmlTag::Attributes() const {
  std::vector<XmlAttribute> found;
  std::string_view rest = attributes;
  for (;;) {
    // name, equals sign, quoted value
    const std::size_t begin = rest.find_first_not_of(kBlanks);
    const std::size_t equals = rest.find('=');
    if (begin == std::string_view::npos || equals == std::string_view::npos || equals < begin) {
      return found;
    }
    std::string_view key = rest.substr(begin, equals - begin);
    key = key.substr(0, key.find_last_not_of(kBlanks) + 1);
    const std::size_t opening = rest.find_first_not_of(kBlanks, equals + 1);
    if (opening == std::string_view::npos) return found;
    const std::size_t closing = rest.find(rest[opening], opening + 1);
    if (closing == std::string_view::npos) return found;
    found.push_back({key, rest.substr(opening + 1, closing - opening - 1)});
    rest.remove_prefix(closing + 1);
  }
}

std::optional<std::string_view> XmlTag::Attribute(std::string_view wanted) const {
  for (const auto& [key, value] : Attributes()) {
    if (key == wanted) return value;
  }
  return std::nullopt;
}

std::optional<XmlTag> XmlTagReader::Next() {
  for (;;) {
    // text up to the next tag
    Take(std::min(rest_.find('<'), rest_.size()));
    if (rest_.empty()) return std::nullopt;
    // comments, raw text, instructions and declarations are no tags
    if (rest_.starts_with("<!--")) {
      Take(Through(rest_, "-->"));
    } else if (rest_.starts_with("<![CDATA[")) {
      Take(Through(rest_, "]]>"));
    } else if (rest_.starts_with("<?")) {
      Take(Through(rest_, "?>"));
    } else if (rest_.starts_with("<!")) {
      Take(Through(rest_, ">"));
    } else {
      const int line = line_;
      return Parsed(Take(SizeOfTag(rest_)), line);
    }
  }
}

std::string_view XmlTagReader::Take(std::size_t size) {
  const std::string_view taken = rest_.substr(0, size);
  rest_.remove_prefix(size);
  line_ += static_cast<int>(std::count(taken.begin(), taken.end(), '\n'));
  return taken;
}

bool IsUrdf(std::string_view text) {
  const auto root = XmlTagReader(text).Next();
  return root && root->name == "robot";
}

std::string EscapeXml(std::string_view text) {
  constexpr std::pair<char, std::string_view> entities[]{
      {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
  std::string result;
  // characters that XML 1.0 has not, and those that a parser makes blanks of, become codes
  for (const char c : Printable(text)) {
    const auto found = std::ranges::find(entities, c, &std::pair<char, std::string_view>::first);
    result += found == std::end(entities) ? std::string(1, c) : std::string(found->second);
  }
  return result;
}

}  // namespace warmjoint
