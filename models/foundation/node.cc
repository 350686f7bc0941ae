#include "models/foundation/node.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "models/foundation/atomic_file.h"
#include "models/foundation/data_folder.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/names.h"
#include "models/foundation/parse_number.h"

namespace warmjoint {
namespace {

std::string NameOrDocument(const std::string& key) { return key.empty() ? "the document" : key; }

/// Refuses brackets within brackets beyond kDeepestJson, which code that walks the tree may not bear.
void CheckDepth(const std::string& text, const std::string& file) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    // brackets within texts do not count; a backslash takes the next character with it
    if (quoted) {
      if (c == '\\') ++i;
      quoted = c != '"';
    } else if (c == '"') {
      quoted = true;
    } else if (c == '[' || c == '{') {
      if (++depth <= kDeepestJson) continue;
      Refuse(PlaceOfByte(text, i, file), "nests deeper than {} levels; what is read here has fewer",
             kDeepestJson);
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
}

/// What a library's message quotes last: the number that it could not hold.
std::string_view Quoted(std::string_view message) {
  const std::size_t end = message.rfind('\'');
  if (end == std::string_view::npos || end == 0) return {};
  const std::size_t begin = message.rfind('\'', end - 1);
  if (begin == std::string_view::npos) return {};
  return message.substr(begin + 1, end - begin - 1);
}

/// Refuses control characters in keys, which are names, and in texts, whose own tabs and line ends are. key: of the tree
void CheckTexts(const Tree& tree, const std::string& key, const Place& place) {
  if (tree.is_string()) {
    const auto& text = tree.get_ref<const std::string&>();
    RequireText(key.empty() ? "the text" : fmt::format("the text of '{}',", key), text, place);
  }
  if (tree.is_array()) {
    for (const Tree& entry : tree) CheckTexts(entry, key, place);
  }
  if (!tree.is_object()) return;
  for (const auto& [name, entry] : tree.items()) {
    RequireName("the key", name, place);
    CheckTexts(entry, name, place);
  }
}

}  // namespace

std::string Bounds::Words() const {
  std::string words;
  const auto add = [&](double bound, const char* relation) {
    if (!std::isfinite(bound)) return;
    words += fmt::format("{}{} {}", words.empty() ? "a number " : " and ", relation, bound);
  };
  add(above, "above");
  add(at_least, "of at least");
  add(below, "below");
  add(at_most, "of at most");
  return words.empty() ? "a finite number" : words;
}

Node::Node(Tree root, const std::string& file, Places places, Scalars scalars)
    : tree_(std::make_shared<const Tree>(std::move(root))),
      document_(std::make_shared<const Document>(Document{file, std::move(places), scalars})) {}

Place Node::PlaceOf(std::string_view key) const {
  // a value without a place of its own stands where the value around it does
  while (true) {
    const auto found = document_->places.find(key);
    if (found != document_->places.end()) return found->second;
    if (key.empty()) return {document_->file};
    const std::size_t dot = key.rfind('.');
    key = key.substr(0, dot == std::string_view::npos ? 0 : dot);
  }
}

std::string Node::Shown() const {
  if (IsMap()) return "a map";
  if (IsList()) return fmt::format("a list of {}", tree_->size());
  if (tree_->is_null()) return "nothing";
  return fmt::format("'{}'", Excerpt(ScalarText()));
}

std::vector<std::string> Node::Keys() const {
  if (!IsMap()) RefuseValue("a map");
  std::vector<std::string> keys;
  for (const auto& [name, value] : tree_->items()) keys.push_back(name);
  return keys;
}

void Node::RequireKnownKeys(const std::vector<std::string>& known) const {
  if (!IsMap()) {
    RefuseValue("a map with entries among: " + fmt::format("{}", fmt::join(known, ", ")));
  }
  if (unknown_ == UnknownKeys::ignored) return;
  for (const std::string& name : Keys()) {
    if (std::ranges::find(known, name) != known.end()) continue;
    Refuse(PlaceOf(KeyOf(name)), "unknown key '{}'{}", Excerpt(KeyOf(name)),
           Suggestion(name, known));
  }
}

void Node::RequireKeys(const std::vector<std::string>& known) const {
  RequireKnownKeys(known);
  for (const auto& [name, value] : tree_->items()) {
    if (!value.is_null() || document_->scalars == Scalars::typed) continue;
    Refuse(PlaceOf(KeyOf(name)), "the key '{}' has no value; give it one, or leave it out",
           Excerpt(KeyOf(name)));
  }
}

std::optional<Node> Node::Find(std::string_view name) const {
  if (!IsMap()) return std::nullopt;
  const auto found = tree_->find(name);
  if (found == tree_->end() || found->is_null()) return std::nullopt;
  return Child(*found, name);
}

bool Node::HoldsNull(std::string_view name) const {
  if (!IsMap() || document_->scalars == Scalars::texts) return false;
  const auto found = tree_->find(name);
  return found != tree_->end() && found->is_null();
}

Node Node::Require(std::string_view name, std::string_view what) const {
  if (const auto found = Find(name)) return *found;
  Refuse(place(), "'{}' is missing; {}", KeyOf(name), what);
}

std::vector<Node> Node::List(std::string_view what) const {
  if (!IsList() || tree_->empty()) RefuseValue(what);
  return Entries(what);
}

std::vector<Node> Node::Entries(std::string_view what) const {
  if (!IsList()) RefuseValue(what);
  std::vector<Node> entries;
  for (const Tree& entry : *tree_) entries.push_back(Child(entry, std::to_string(entries.size())));
  return entries;
}

std::optional<double> Node::AsNumber() const {
  if (tree_->is_number()) return tree_->get<double>();
  if (!tree_->is_string() || document_->scalars == Scalars::typed) return std::nullopt;
  return ParseNumber(tree_->get_ref<const std::string&>());
}

double Node::Number(const Bounds& bounds) const {
  const std::optional<double> number = AsNumber();
  if (!number || !std::isfinite(*number) || !bounds.Hold(*number)) RefuseValue(bounds.Words());
  return *number;
}

std::int64_t Node::Whole(std::int64_t lowest, std::int64_t highest) const {
  const auto number = IsScalar() ? ParseInteger(ScalarText()) : std::nullopt;
  if (!number || *number < lowest || *number > highest) {
    RefuseValue(fmt::format("a whole number from {} to {}", lowest, highest));
  }
  return *number;
}

std::uint64_t Node::Seed() const {
  const auto number = IsScalar() ? ParseUnsigned(ScalarText()) : std::nullopt;
  if (!number) RefuseValue("a whole number from 0 to 18446744073709551615");
  return *number;
}

std::string Node::ScalarText() const {
  if (!IsScalar()) RefuseValue("text");
  return tree_->is_string() ? tree_->get<std::string>() : tree_->dump();
}

std::string Node::Text() const {
  const bool is_text = document_->scalars == Scalars::texts ? IsScalar() : tree_->is_string();
  if (!is_text) RefuseValue("text");
  return ScalarText();
}

std::pair<double, double> Node::Interval(const Bounds& bounds) const {
  const std::string must_be =
      fmt::format("[lower, upper], lower below upper, each {}", bounds.Words());
  const std::vector<Node> ends = List(must_be);
  if (ends.size() != 2) RefuseValue(must_be);
  const std::pair interval{ends[0].Number(bounds), ends[1].Number(bounds)};
  if (interval.first < interval.second) return interval;
  Refuse(place(), "{} is [{}, {}]; the lower end must be below the upper", key_, interval.first,
         interval.second);
}

Node Node::With(Tree tree) const {
  Node node = *this;
  node.tree_ = std::make_shared<const Tree>(std::move(tree));
  return node;
}

Node Node::With(UnknownKeys keys) const {
  Node node = *this;
  node.unknown_ = keys;
  return node;
}

void Node::RefuseValue(std::string_view must_be) const {
  Refuse(place(), "{} is {}; it must be {}", NameOrDocument(key_), Shown(), must_be);
}

std::string Node::KeyOf(std::string_view name) const {
  return key_.empty() ? std::string(name) : fmt::format("{}.{}", key_, name);
}

Node Node::Child(const Tree& tree, std::string_view name) const {
  // the pointer to the entry shares the ownership of the whole
  Node child = *this;
  child.tree_ = std::shared_ptr<const Tree>(tree_, &tree);
  child.key_ = KeyOf(name);
  return child;
}

void RefuseWord(const Node& node, const std::string& word, const std::vector<std::string>& known) {
  Refuse(node.place(), "{} is '{}'{}", NameOrDocument(node.key()), Excerpt(word),
         Suggestion(word, known));
}

namespace {

/// The robot.json of a machine of the library, or what that holds of one joint.
Tree ReadOfLibrary(const std::filesystem::path& path) {
  const LibraryFriction known = FindInLibrary(path);
  Tree robot = ReadJsonFile(known.file);
  if (known.joint.empty()) return robot;
  std::vector<std::string> joints;
  for (const auto& [name, estimate] : robot["joints"].items()) {
    if (name == known.joint) return estimate;
    joints.push_back(name);
  }
  Refuse({Excerpt(path.string())}, "this machine has no joint '{}'{}", Excerpt(known.joint),
         Suggestion(known.joint, joints));
}

}  // namespace

Node ReadJsonNode(const std::filesystem::path& path) { return {ReadJsonFile(path), path.string()}; }

Node ParseJsonNode(const std::string& text, const std::string& file) {
  return {ParseJson(text, file), file};
}

Tree ReadJsonFile(const std::filesystem::path& path) {
  if (IsOfLibrary(path)) return ReadOfLibrary(path);
  const std::string text = ReadWholeFile(path, kLargestJson);
  // of all that is given in place of such a file, a recording is the likeliest
  constexpr std::string_view mark = "\xEF\xBB\xBF";  // of UTF-8, which some editors write
  const std::string_view content =
      Trimmed(std::string_view(text).substr(text.starts_with(mark) ? mark.size() : 0));
  if (!content.empty() && content.front() != '{' && content.front() != '[') {
    Refuse({path.string()},
           "is no JSON file; if it is a recording, identify it first: warmjoint identify {} -o "
           "estimate.json",
           path.string());
  }
  return ParseJson(text, path.string());
}

Tree ParseJson(const std::string& text, const std::string& file) {
  if (const auto broken = FirstBrokenByte(text)) {
    Refuse(PlaceOfByte(text, *broken, file), "byte {} is not UTF-8, as JSON must be", *broken + 1);
  }
  CheckDepth(text, file);
  try {
    Tree tree = [&] {
      const auto turn = JsonTurn();
      return Tree::parse(text);
    }();
    CheckTexts(tree, "", {file});
    return tree;
  } catch (const nlohmann::json::parse_error& error) {
    Refuse(PlaceOfByte(text, error.byte, file), "is not JSON: {}",
           Excerpt(error.what(), kLongestComplaint));
  } catch (const nlohmann::json::out_of_range& error) {
    // the library tells no place, but the number, which is looked for
    const std::string_view number = Quoted(error.what());
    Refuse(PlaceOfByte(text, text.find(number), file),
           "{} is beyond the largest number, 1.8e308; write null for what is unknown",
           Excerpt(number));
  }
}

Place PlaceOfByte(const std::string& text, std::size_t byte, const std::string& file) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size()));
  return {file, static_cast<int>(1 + std::count(text.begin(), end, '\n'))};
}

}  // namespace warmjoint
