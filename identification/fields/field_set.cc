#include "identification/fields/field_set.h"

#include <algorithm>
#include <sstream>

namespace warmjoint {

FieldSet FieldSet::All() {
  FieldSet all;
  for (const Word<FieldKind>& word : WordsOf(FieldKind{})) all.kinds.push_back(word.value);
  return all;
}

std::optional<FieldSet> FieldsIn(const std::string& text) {
  FieldSet set;
  if (text == "none") return set;
  if (text == "auto") return FieldSet::All();
  // one more comma, so that nothing after the last is a letter as well
  std::istringstream letters(text + ",");
  for (std::string letter; std::getline(letters, letter, ',');) {
    const auto words = WordsOf(FieldKind{});
    const auto word = std::ranges::find(words, letter, &Word<FieldKind>::name);
    if (word == words.end() || set.Has(word->value)) return std::nullopt;
    set.kinds.push_back(word->value);
  }
  return set;
}

void ReadValue(const Node& node, FieldSet* value, const FieldInfo&) {
  const auto set = FieldsIn(node.Text());
  if (!set) node.RefuseValue(kWordsOfFields);
  *value = *set;
}

Tree WriteValue(const FieldSet& value) {
  if (value.kinds.empty()) return "none";
  if (value == FieldSet::All()) return "auto";
  std::string text;
  for (const FieldKind kind : value.kinds)
    text += (text.empty() ? "" : ",") + std::string(NameOf(kind));
  return text;
}

}  // namespace warmjoint
