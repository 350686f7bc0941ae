#include "scenarios/yaml_value.h"

#include <algorithm>
#include <cmath>

#include "models/foundation/excerpt.h"
#include "models/foundation/nearest_name.h"
#include "models/foundation/parse_number.h"

namespace warmjoint::inline scenarios {
namespace {

YAML::Node ParseYaml(const std::string& text, const std::string& file) {
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    Refuse({file, error.mark.line + 1}, "is not YAML: {}", error.msg);
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
  if (dot != std::string_view::npos) {
    if (!map[name] || map[name].IsNull()) map[name] = YAML::Node(YAML::NodeType::Map);
    return Set(map[name], path.substr(dot + 1), value, place);
  }
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
  std::vector<std::string> keys;
  for (const auto& entry : node_) keys.push_back(entry.first.Scalar());
  return keys;
}

void YamlValue::RequireKeys(const std::vector<std::string>& known) const {
  if (!IsMap())
    RefuseValue("a map with entries among: " + fmt::format("{}", fmt::join(known, ", ")));
  std::vector<std::string> seen;
  for (const auto& entry : node_) {
    const std::string name = entry.first.Scalar();
    const Place where = YamlValue(entry.first, KeyOf(name), document_).place();
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      Refuse(where, "unknown key '{}'{}", Excerpt(KeyOf(name)), Suggestion(name, known));
    }
    if (std::find(seen.begin(), seen.end(), name) != seen.end()) {
      Refuse(where, "the key '{}' stands twice; keep one", Excerpt(KeyOf(name)));
    }
    seen.push_back(name);
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

std::int64_t YamlValue::Integer(Bound bound) const {
  const auto number = IsScalar() ? ParseInteger(node_.Scalar()) : std::nullopt;
  if (!number || !Satisfies(static_cast<double>(*number), bound)) {
    RefuseValue(fmt::format("{}, and whole", Words(bound)));
  }
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
