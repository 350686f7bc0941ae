#include "scenarios/yaml.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>

#include "models/foundation/excerpt.h"
#include "models/foundation/parse_number.h"

namespace warmjoint {
namespace {

/// The line on which a second document begins; 0: none. YAML::LoadAll does not end on some broken texts.
int SecondDocument(std::string_view text) {
  bool content = false;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    // a marker begins a second document where anything stands before it
    const bool marker = line.starts_with("---") && line.find_first_not_of(" \t\r", 3) != 3;
    if (marker && content) return number;
    const std::size_t first = line.find_first_not_of(" \t\r", marker ? 3 : 0);
    const bool nothing = first == std::string_view::npos || line[first] == '#' || line[0] == '%';
    content = content || !nothing;
  }
  return 0;
}

YAML::Node Load(const std::string& text, const std::string& file) {
  // text that is no UTF-8 and a second document are refused by their line
  if (const auto broken = FirstBrokenByte(text)) {
    Refuse(PlaceOfByte(text, *broken, file), "byte {} is not UTF-8; save the file as UTF-8",
           *broken + 1);
  }
  if (const int line = SecondDocument(text)) {
    Refuse({file, line}, "begins another document; keep one");
  }
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    Refuse({file, error.mark.line + 1}, "is not YAML: {}", Excerpt(error.msg, kLongestComplaint));
  }
}

std::string Join(const std::string& key, const std::string& name) {
  return key.empty() ? name : key + "." + name;
}

/// Makes a tree of a document, and notes where its values stand.
class TreeMaker {
 public:
  TreeMaker(const std::string& file, Places& places) : file_(file), places_(places) {}

  /// key: where the value stands in the whole; around: the place of what holds it.
  Tree Make(const YAML::Node& node, const std::string& key, int around, int depth) {
    const bool placed = !node.IsNull() && !node.Mark().is_null();
    const int line = placed ? node.Mark().line + 1 : around;
    CheckShape(line, depth);
    if (line != around) places_[key] = {file_, line};
    if (node.IsMap()) return MakeMap(node, key, line, depth);
    if (node.IsScalar()) return node.Scalar();
    if (!node.IsSequence()) return {};
    Tree list = Tree::array();
    for (const auto& entry : node) {
      list.push_back(Make(entry, Join(key, std::to_string(list.size())), line, depth + 1));
    }
    return list;
  }

 private:
  /// Refuses trees that walking would not end on, or not soon: aliases make cycles, and of a small
  /// file a large tree.
  void CheckShape(int line, int depth) {
    if (depth > kDeepestDocument) {
      Refuse({file_, line},
             "nests deeper than {} levels, or holds itself by an alias; write it out",
             kDeepestDocument);
    }
    if (++count_ > kMostValues) {
      Refuse({file_, line},
             "holds more than {} values, those of aliases counted each time; write less",
             kMostValues);
    }
  }

  Tree MakeMap(const YAML::Node& node, const std::string& key, int line, int depth) {
    Tree map = Tree::object();
    for (const auto& entry : node) {
      const Place place{file_, entry.first.Mark().line + 1};
      // keys are words, each there once
      if (!entry.first.IsScalar()) Refuse(place, "has a key that is not a word; name it");
      const std::string& name = entry.first.Scalar();
      const std::string whole = Join(key, name);
      if (map.contains(name)) Refuse(place, "the key '{}' stands twice; keep one", Excerpt(whole));
      if (place.line != line) places_[whole] = place;
      map[name] = Make(entry.second, whole, place.line, depth + 1);
    }
    return map;
  }

  const std::string& file_;
  Places& places_;
  int count_ = 0;  // of the values so far
};

/// Sets one entry, making the maps on the way. path: what is left of the dotted key.
void Set(Tree& map, std::string_view path, Tree value, const Place& place) {
  const size_t dot = path.find('.');
  const std::string name(path.substr(0, dot));
  if (name.empty()) Refuse(place, "the key has an empty part; write it as noise.torque");
  if (map.is_null()) map = Tree::object();
  if (!map.is_object()) {
    Refuse(place, "there is no entry '{}' below a value that is no map", Excerpt(path));
  }
  // maps on the way are made where they are missing
  if (dot != std::string_view::npos)
    return Set(map[name], path.substr(dot + 1), std::move(value), place);
  // null takes the entry out
  if (value.is_null()) {
    map.erase(name);
  } else {
    map[name] = std::move(value);
  }
}

/// Whether the value of `key` is that of `outer` or stands within it.
bool Within(std::string_view key, std::string_view outer) {
  return key.starts_with(outer) && (key.size() == outer.size() || key[outer.size()] == '.');
}

void Apply(const Setting& setting, Tree& root, Places& places) {
  const Place place{fmt::format("--set {}", Excerpt(setting.key + "=" + setting.value))};
  Places within;  // all of the value has one place: that of the setting
  Tree value = TreeMaker(place.file, within).Make(Load(setting.value, place.file), "", 0, 0);
  Set(root, setting.key, std::move(value), place);
  std::erase_if(places, [&](const auto& one) { return Within(one.first, setting.key); });
  places[setting.key] = place;
  // and so have the maps that it made on the way
  std::string outer = setting.key;
  for (std::size_t dot; (dot = outer.rfind('.')) != std::string::npos;) {
    outer.resize(dot);
    const bool has_place = std::ranges::any_of(places, [&](const auto& one) {
      return Within(one.first, outer) && one.first != setting.key;
    });
    if (!has_place) places[outer] = place;
  }
}

/// Whether a text stands as it is for itself: words, paths, and nothing that YAML reads otherwise.
bool IsPlain(const std::string& text) {
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '.' || c == '/';
  };
  const bool word = !text.empty() && std::isalpha(static_cast<unsigned char>(text[0])) &&
                    std::ranges::all_of(text, [&](char c) { return plain(c) || c == '-'; });
  return (word && text != "null" && text != "Null" && text != "NULL") || ParseFinite(text);
}

std::string ScalarToYaml(const Tree& value) {
  if (value.is_number_float()) return fmt::format("{}", value.get<double>());
  if (!value.is_string()) return value.dump();
  // a JSON string is a double-quoted YAML scalar
  const auto& text = value.get_ref<const std::string&>();
  return IsPlain(text) ? text : value.dump();
}

constexpr std::size_t kLongestLine = 100;  // of a map or list that stands on one line

}  // namespace

Node ParseYaml(const std::string& text, const std::string& file, const Settings& settings) {
  Places places;
  Tree root = TreeMaker(file, places).Make(Load(text, file), "", 0, 0);
  // settings count in order, the last one of a key in the end
  for (const Setting& setting : settings) Apply(setting, root, places);
  return {std::move(root), file, std::move(places), Scalars::texts};
}

std::string ToFlowYaml(const Tree& value) {
  if (!value.is_structured()) return ScalarToYaml(value);
  std::string entries;
  for (const auto& [name, entry] : value.items()) {
    if (!entries.empty()) entries += ", ";
    if (value.is_object()) entries += ScalarToYaml(name) + ": ";
    entries += ToFlowYaml(entry);
  }
  return value.is_object() ? "{" + entries + "}" : "[" + entries + "]";
}

std::string ToYaml(const Tree& map, const std::string& indent) {
  std::string yaml;
  for (const auto& [name, value] : map.items()) {
    const std::string key = indent + ScalarToYaml(name) + ":";
    const std::string line = ToFlowYaml(value);
    // on one line where it is short or a list of numbers
    const bool maps = value.is_array() && !value.empty() && value[0].is_object();
    if (!value.is_structured() || value.empty() || (value.is_array() && !maps) ||
        key.size() + line.size() < kLongestLine) {
      yaml += fmt::format("{} {}\n", key, line);
    } else if (value.is_object()) {
      yaml += fmt::format("{}\n{}", key, ToYaml(value, indent + "  "));
    } else {
      yaml += key + "\n";
      for (const Tree& entry : value) yaml += fmt::format("{}  - {}\n", indent, ToFlowYaml(entry));
    }
  }
  return yaml;
}

}  // namespace warmjoint
