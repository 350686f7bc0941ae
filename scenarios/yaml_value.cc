#include "scenarios/yaml_value.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "models/foundation/excerpt.h"
#include "models/foundation/nearest_name.h"
#include "models/foundation/parse_number.h"

namespace warmjoint::inline scenarios {
namespace {

/// Refuses trees that walking would not end on, or not soon: aliases make cycles, and of a small
/// file a large tree. count: of the values so far.
void CheckShape(const YAML::Node& node, int depth, int& count, const std::string& file) {
  const Place place{file, node.Mark().line + 1};
  if (depth > kDeepestDocument) {
    Refuse(place, "nests deeper than {} levels, or holds itself by an alias; write it out",
           kDeepestDocument);
  }
  if (++count > kMostValues) {
    Refuse(place, "holds more than {} values, those of aliases counted each time; write less",
           kMostValues);
  }
  // values below count, too; keys must be words
  if (node.IsMap()) {
    for (const auto& entry : node) {
      if (!entry.first.IsScalar()) {
        Refuse({file, entry.first.Mark().line + 1}, "has a key that is not a word; name it");
      }
      CheckShape(entry.second, depth + 1, count, file);
    }
  } else if (node.IsSequence()) {
    for (const auto& entry : node) CheckShape(entry, depth + 1, count, file);
  }
}

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

YAML::Node ParseYaml(const std::string& text, const std::string& file) {
  // text that is no UTF-8 and a second document are refused by their line
  if (const auto broken = FirstBrokenByte(text)) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(*broken);
    const auto line = static_cast<int>(1 + std::count(text.begin(), end, '\n'));
    Refuse({file, line}, "byte {} is not UTF-8; save the file as UTF-8", *broken + 1);
  }
  if (const int line = SecondDocument(text)) {
    Refuse({file, line}, "begins another document; keep one");
  }
  // the tree itself must be of a size that can be walked
  try {
    const YAML::Node root = YAML::Load(text);
    int count = 0;
    CheckShape(root, 0, count, file);
    return root;
  } catch (const YAML::Exception& error) {
    Refuse({file, error.mark.line + 1}, "is not YAML: {}", Excerpt(error.msg, kLongestComplaint));
  }
}

/// Sets one entry, making the maps on the way. path: what is left of the dotted key.
void Set(YAML::Node map, std::string_view path, const YAML::Node& value, const Place& place) {
  const size_t dot = path.find('.');
  const std::string name(path.substr(0, dot));
  if (name.empty()) Refuse(place, "the key has an empty part; write it as noise.torque");
  if (!map.IsMap() && !map.IsNull()) {
    Refuse(place, "there is no entry '{}' below a value that is no map", Excerpt(path));
  }
  // maps on the way are made where they are missing
  if (dot != std::string_view::npos) {
    if (!map[name] || map[name].IsNull()) map[name] = YAML::Node(YAML::NodeType::Map);
    return Set(map[name], path.substr(dot + 1), value, place);
  }
  // null takes the entry out
  if (value.IsNull()) {
    map.remove(name);
  } else {
    map[name] = value;
  }
}

Place PlaceOf(const Setting& setting) {
  return {fmt::format("--set {}", Excerpt(setting.key + "=" + setting.value))};
}

/// Whether the value of `key` is that of `outer` or stands within it.
bool Leads(const std::string& outer, const std::string& key) {
  return key.starts_with(outer) && (key.size() == outer.size() || key[outer.size()] == '.');
}

std::string_view Words(Bound bound) {
  switch (bound) {
    case Bound::any:
      return "a finite number";
    case Bound::not_negative:
      return "a number of at least 0";
    case Bound::positive:
      return "a number above 0";
  }
  return "";
}

bool Satisfies(double value, Bound bound) {
  if (bound == Bound::not_negative) return value >= 0;
  if (bound == Bound::positive) return value > 0;
  return true;
}

}  // namespace

YamlValue YamlValue::Parse(const std::string& text, const std::string& file,
                           const Settings& settings) {
  YAML::Node root = ParseYaml(text, file);
  // settings count in order, the last one of a key in the end
  for (const Setting& setting : settings) {
    const Place place = PlaceOf(setting);
    Set(root, setting.key, ParseYaml(setting.value, place.file), place);
  }
  return {root, "", std::make_shared<Document>(Document{file, settings})};
}

Place YamlValue::place() const {
  // the last setting that changed this value, one that holds it, or, for a value that is not in
  // the file, one inside it
  const auto& settings = document_->settings;
  const bool in_file = !node_.Mark().is_null();
  for (auto setting = settings.rbegin(); setting != settings.rend(); ++setting) {
    if (Leads(setting->key, key_) || (!in_file && Leads(key_, setting->key))) {
      return PlaceOf(*setting);
    }
  }
  return {document_->file, in_file ? node_.Mark().line + 1 : 0};
}

std::string YamlValue::Shown() const {
  if (node_.IsScalar()) return fmt::format("'{}'", Excerpt(node_.Scalar()));
  if (node_.IsSequence()) return fmt::format("a list of {}", node_.size());
  if (node_.IsMap()) return "a map";
  return "nothing";
}

std::vector<std::string> YamlValue::Keys() const {
  if (!IsMap()) RefuseValue("a map");
  std::vector<std::string> keys;
  for (const auto& entry : node_) keys.push_back(entry.first.Scalar());
  return keys;
}

void YamlValue::RequireKnownKeys(const std::vector<std::string>& known) const {
  if (!IsMap())
    RefuseValue("a map with entries among: " + fmt::format("{}", fmt::join(known, ", ")));
  for (const auto& entry : node_) {
    const std::string name = entry.first.Scalar();
    // told by the line of the key itself
    const Place where = YamlValue(entry.first, KeyOf(name), document_).place();
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      Refuse(where, "unknown key '{}'{}", Excerpt(KeyOf(name)), Suggestion(name, known));
    }
  }
  RequireDistinctKeys();
}

void YamlValue::RequireKeys(const std::vector<std::string>& known) const {
  RequireKnownKeys(known);
  for (const auto& entry : node_) {
    if (!entry.second.IsNull()) continue;
    const std::string name = entry.first.Scalar();
    Refuse(YamlValue(entry.first, KeyOf(name), document_).place(),
           "the key '{}' has no value; give it one, or leave it out", Excerpt(KeyOf(name)));
  }
}

void YamlValue::RequireDistinctKeys() const {
  if (!IsMap()) RefuseValue("a map");
  std::set<std::string> seen;
  for (const auto& entry : node_) {
    const std::string name = entry.first.Scalar();
    if (seen.insert(name).second) continue;
    Refuse(YamlValue(entry.first, KeyOf(name), document_).place(),
           "the key '{}' stands twice; keep one", Excerpt(KeyOf(name)));
  }
}

std::optional<YamlValue> YamlValue::Find(std::string_view name) const {
  for (const auto& entry : node_) {
    if (entry.first.Scalar() != name || entry.second.IsNull()) continue;
    return YamlValue(entry.second, KeyOf(name), document_);
  }
  return std::nullopt;
}

YamlValue YamlValue::Require(std::string_view name, std::string_view what) const {
  if (const auto found = Find(name)) return *found;
  Refuse(place(), "'{}' is missing; {}", KeyOf(name), what);
}

std::vector<YamlValue> YamlValue::List(std::string_view what) const {
  if (!IsList() || node_.size() == 0) RefuseValue(what);
  std::vector<YamlValue> values;
  for (size_t i = 0; i < node_.size(); ++i) {
    values.push_back({node_[i], KeyOf(std::to_string(i)), document_});
  }
  return values;
}

double YamlValue::Number(Bound bound) const {
  const auto number = IsScalar() ? ParseNumber(node_.Scalar()) : std::nullopt;
  if (!number || !std::isfinite(*number) || !Satisfies(*number, bound)) RefuseValue(Words(bound));
  return *number;
}

std::int64_t YamlValue::Whole(std::int64_t lowest, std::int64_t highest) const {
  const auto number = IsScalar() ? ParseInteger(node_.Scalar()) : std::nullopt;
  if (!number || *number < lowest || *number > highest) {
    RefuseValue(fmt::format("a whole number from {} to {}", lowest, highest));
  }
  return *number;
}

std::uint64_t YamlValue::Seed() const {
  const auto number = IsScalar() ? ParseUnsigned(node_.Scalar()) : std::nullopt;
  if (!number) RefuseValue("a whole number from 0 to 18446744073709551615");
  return *number;
}

std::string YamlValue::Text() const {
  if (!IsScalar()) RefuseValue("text");
  return node_.Scalar();
}

std::pair<double, double> YamlValue::Interval(Bound bound) const {
  const std::string must_be =
      fmt::format("[lower, upper], lower below upper, each {}", Words(bound));
  const std::vector<YamlValue> ends = List(must_be);
  if (ends.size() != 2) RefuseValue(must_be);
  const std::pair interval{ends[0].Number(bound), ends[1].Number(bound)};
  if (!(interval.first < interval.second)) {
    Refuse(place(), "{} is [{}, {}]; the lower end must be below the upper", key_, interval.first,
           interval.second);
  }
  return interval;
}

void YamlValue::RefuseValue(std::string_view must_be) const {
  Refuse(place(), "{} is {}; it must be {}", key_.empty() ? "the document" : key_, Shown(),
         must_be);
}

std::string YamlValue::KeyOf(std::string_view name) const {
  return key_.empty() ? std::string(name) : fmt::format("{}.{}", key_, name);
}

std::string FlowYaml(const YAML::Node& node) {
  YAML::Node copy = YAML::Clone(node);
  copy.SetStyle(YAML::EmitterStyle::Flow);
  YAML::Emitter emitter;
  emitter << copy;
  return emitter.c_str();
}

}  // namespace warmjoint::inline scenarios
