#include "scenarios/yaml_friction.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "models/foundation/excerpt.h"
#include "models/foundation/parse_number.h"
#include "models/foundation/read_json.h"
#include "models/friction/friction_json.h"
#include "scenarios/yaml_distribution.h"

namespace warmjoint::inline scenarios {
namespace {

using nlohmann::json;

constexpr std::string_view kPrefix = "friction.";

/// Where the number of a drawn key stands in the friction's JSON.
json::json_pointer Pointer(const std::string& key) {
  std::string path = key.substr(kPrefix.size() - 1);
  std::replace(path.begin(), path.end(), '.', '/');
  return json::json_pointer(path);
}

double Middle(const Distribution& range) {
  return range.kind == Distribution::Kind::log_uniform ? std::sqrt(range.a * range.b)
                                                       : (range.a + range.b) / 2;
}

json ScalarToJson(const YamlValue& value) {
  const std::string text = value.Text();
  // a number within quotes is text
  const bool quoted = value.node().Tag() == "!";
  if (!quoted && ParseNumber(text)) return value.Number();
  return text;
}

/// YAML as JSON, distributions replaced by their middles and added to `draws`. key: dotted, from
/// friction on.
json ToJson(const YamlValue& value, const std::string& key, TruthDraws& draws) {
  // a range stands for its middle until it is drawn
  if (IsDistribution(value)) {
    const Distribution range = ReadDistribution(value, Bound::any);
    if (range.kind == Distribution::Kind::normal) {
      value.RefuseValue("uniform or log_uniform, which keep a truth within its bounds");
    }
    draws.numbers[key] = range;
    return Middle(range);
  }
  if (value.IsMap()) {
    json object = json::object();
    value.RequireDistinctKeys();
    for (const std::string& name : value.Keys()) {
      // names make dotted keys and paths into JSON
      if (name.empty() || name.find_first_of("./~") != std::string::npos) {
        Refuse(value.place(), "unknown key '{}' in {}: names hold no '.', '/' or '~'",
               Excerpt(name), Excerpt(value.key()));
      }
      const auto entry = value.Find(name);
      if (entry) object[name] = ToJson(*entry, fmt::format("{}.{}", key, name), draws);
    }
    return object;
  }
  // entries of a list are known by their place in it
  if (value.IsList()) {
    json list = json::array();
    for (const YamlValue& entry : value.List("a list that is not empty")) {
      list.push_back(ToJson(entry, fmt::format("{}.{}", key, list.size()), draws));
    }
    return list;
  }
  return ScalarToJson(value);
}

/// Refuses ranges whose ends the parameter tables do not allow.
void CheckEnds(const json& middles, const TruthDraws& draws, const Place& place) {
  json lower = middles;
  json upper = middles;
  // each range at its lower, and at its upper end
  for (const auto& [key, range] : draws.numbers) {
    if (!key.starts_with(kPrefix)) continue;
    lower[Pointer(key)] = range.a;
    upper[Pointer(key)] = range.b;
  }
  FrictionFromJson(lower, place);
  FrictionFromJson(upper, place);
}

std::string ScalarToYaml(const json& value) {
  if (value.is_number_float()) return fmt::format("{}", value.get<double>());
  if (!value.is_string()) return value.dump();
  // a text that reads as a number keeps its quotes
  const std::string text = value.get<std::string>();
  return ParseNumber(text) ? value.dump() : text;
}

/// Maps one entry a line; lists are written as JSON, which is YAML too.
std::string JsonToYaml(const json& object, const std::string& indent) {
  std::string yaml;
  for (const auto& [name, value] : object.items()) {
    if (value.is_object() && !value.empty()) {
      yaml += fmt::format("{}{}:\n{}", indent, name, JsonToYaml(value, indent + "  "));
    } else {
      yaml += fmt::format("{}{}: {}\n", indent, name, ScalarToYaml(value));
    }
  }
  return yaml;
}

/// The distribution as YAML reads it.
json DistributionToJson(const Distribution& range) {
  const bool logarithmic = range.kind == Distribution::Kind::log_uniform;
  return {{logarithmic ? "log_uniform" : "uniform", {range.a, range.b}}};
}

/// A path relative to the file that names it.
std::string Beside(const YamlValue& value) {
  return std::filesystem::path(value.file()).parent_path() / value.Text();
}

/// {estimate: FILE}, and with `draw: posterior` what the estimate leaves open.
FrictionDescription ReadEstimate(const YamlValue& value, TruthDraws& draws) {
  value.RequireKeys({"estimate", "draw"});
  const std::string path = Beside(*value.Find("estimate"));
  const FrictionDescription friction = ReadFrictionFile(path);
  if (const auto draw = value.Find("draw")) {
    if (draw->Text() != "posterior") draw->RefuseValue("posterior");
    draws.posterior = PosteriorOfEstimate(ReadJsonFile(path), friction, {path});
  }
  return friction;
}

}  // namespace

FrictionDescription ReadFriction(const YamlValue& value, TruthDraws& draws) {
  // a file, an estimate, or the friction itself
  if (value.IsScalar()) return ReadFrictionFile(Beside(value));
  if (value.IsMap() && value.Find("estimate")) return ReadEstimate(value, draws);
  json middles = ToJson(value, "friction", draws);
  // a posterior stands beside the friction, not in it
  const json posterior = middles.is_object() ? middles.value("posterior", json()) : json();
  if (middles.is_object()) middles.erase("posterior");
  CheckEnds(middles, draws, value.place());
  const FrictionDescription friction = FrictionFromJson(middles, value.place());
  if (posterior.is_null()) return friction;
  if (!draws.numbers.empty()) {
    Refuse(value.place(), "friction has a posterior and a distribution for {}; give one of them",
           draws.numbers.begin()->first);
  }
  draws.posterior = PosteriorFromJson(posterior, friction, value.place());
  return friction;
}

std::string FrictionToYaml(const FrictionDescription& friction, const TruthDraws& draws,
                           const std::string& indent) {
  json object = FrictionToJson(friction);
  // drawn numbers as their ranges
  for (const auto& [key, range] : draws.numbers) {
    if (key.starts_with(kPrefix)) object[Pointer(key)] = DistributionToJson(range);
  }
  if (draws.posterior) object["posterior"] = PosteriorToJson(*draws.posterior);
  return JsonToYaml(object, indent);
}

FrictionDescription DrawFriction(const FrictionDescription& friction, const TruthDraws& draws,
                                 RandomStream& random, const Place& place) {
  if (draws.posterior) return Draw(*draws.posterior, friction, random, place);
  json object = FrictionToJson(friction);
  for (const auto& [key, range] : draws.numbers) {
    if (key.starts_with(kPrefix)) object[Pointer(key)] = range.Draw(random);
  }
  return FrictionFromJson(object, place);
}

}  // namespace warmjoint::inline scenarios
