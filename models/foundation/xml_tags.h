// Text as XML has it: its tags one after another, without a tree of them, to look at what may be too large for one; and words as values.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace warmjoint {

/// NAME="VALUE", the value as it is written.
struct XmlAttribute {
  std::string_view name, value;
};

/// One <...> of a text. What is no tag (comments, declarations, character data) is passed over.
struct XmlTag {
  enum class Kind { opens, closes, stands_alone };

  Kind kind = Kind::opens;
  std::string_view name;
  std::string_view attributes;  // as they stand there
  int line = 0;                 // on which it begins

  /// All attributes, in their order.
  std::vector<XmlAttribute> Attributes() const;
  /// The value of an attribute as it is written; nothing where it is absent.
  std::optional<std::string_view> Attribute(std::string_view wanted) const;
};

/// Gives the tags of a text in order. It never refuses: what is no XML, its parser refuses.
class XmlTagReader {
 public:
  explicit XmlTagReader(std::string_view text) : rest_(text) {}

  /// The next tag; nothing at the end.
  std::optional<XmlTag> Next();

 private:
  std::string_view Take(std::size_t size);

  std::string_view rest_;
  int line_ = 1;
};

/// Whether the root element of a text is a URDF's.
bool IsUrdf(std::string_view text);

/// The text as a value of XML: &, <, > and " as entities, and characters that XML 1.0 has not by their codes, as Printable has them.
std::string EscapeXml(std::string_view text);

}  // namespace warmjoint
