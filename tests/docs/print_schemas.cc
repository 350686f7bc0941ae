// Prints what each file may hold as JSON Schemas (draft 2020-12), by what the structs themselves say: one object,
//   {"friction": SCHEMA, "estimate": SCHEMA, "robot": SCHEMA, "scenario": SCHEMA, "suite": SCHEMA, "attributes": SCHEMA}
// tools/docs/tables makes files and tables of it. A number's unit stands there as "unit", beside its "description".
#include <fmt/core.h>
#include <warmjoint/estimate.h>
#include <warmjoint/friction.h>
#include <warmjoint/robot_estimate.h>

#include <nlohmann/json.hpp>

#include "identification/gravity.h"
#include "models/foundation/serialize.h"
#include "scenarios/suite.h"
#include "sim/plugin/attributes.h"

namespace warmjoint {
namespace {

/// How files of a kind differ from what the structs say.
struct Dialect {
  bool texts = false;    // YAML: each scalar is a text, too
  bool written = false;  // all members are there, and a number that is not known is null
  bool drawn = false;    // a number may be a distribution
};

/// A value that may be null, too.
Tree Nullable(const Tree& schema) {
  if (!schema.contains("type")) return {{"anyOf", {schema, {{"type", "null"}}}}};
  Tree nullable = schema;
  if (schema["type"].is_string()) nullable["type"] = {schema["type"], "null"};
  return nullable;
}

Tree ListOf(const Tree& items) { return {{"type", "array"}, {"items", items}}; }

Tree PairOf(const Tree& items) {
  return {{"type", "array"}, {"items", items}, {"minItems", 2}, {"maxItems", 2}};
}

Tree AnyOf(std::initializer_list<Tree> schemas) { return {{"anyOf", std::vector<Tree>(schemas)}}; }

/// The schema of a map with the given members and no other.
Tree MapOf(Tree properties) {
  return {
      {"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
}

Tree Reference(const std::string& to) { return {{"$ref", to}}; }

/// Writes the members of a struct as a schema.
class SchemaWriter {
 public:
  explicit SchemaWriter(Dialect dialect) : dialect_(dialect) {}

  template <class T>
  void Field(std::string_view name, T* value, const FieldInfo& info = {}) {
    Tree schema = Of(*value, info);
    if (info.at_default == AtDefault::null) schema = Nullable(schema);
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T> || std::same_as<T, Distribution>) {
      const Tree at_default = WriteValue(*value);
      const bool allowed = !at_default.is_number() || info.bounds.Hold(at_default.get<double>());
      if (info.needed.empty() && allowed && !dialect_.written) schema["default"] = at_default;
    }
    constexpr bool optional = requires { value->has_value(); };
    const bool always =
        info.at_default == AtDefault::null || (info.at_default == AtDefault::written && !optional);
    Add(name, schema, info, !info.needed.empty() || (dialect_.written && always));
  }
  template <class T>
  void Named(std::string_view name, std::vector<T>*, const FieldInfo& info = {}) {
    const Tree map{{"type", "object"}, {"additionalProperties", Of(T{}, {})}};
    Add(name, map, info, !info.needed.empty());
  }
  void Flag(std::string_view name, const bool*, std::string_view meaning = {}) {
    Add(name, MapOf(Tree::object()), {.meaning = meaning}, false);
  }
  void Require(bool, std::string_view, std::string_view) {}
  void Check(bool, std::string_view, std::string_view) {}

  /// The schema of a struct's members.
  template <Described T>
  Tree Members(T value) const {
    SchemaWriter inner(dialect_);
    value.Serialize(&inner);
    Tree schema = MapOf(inner.properties_);
    if (!inner.required_.empty()) schema["required"] = inner.required_;
    return schema;
  }

  /// A friction with the laws and parameters that there are.
  Tree OfFriction() const {
    Tree schema = Members(Friction());
    SchemaWriter parameters(dialect_);
    for (const Law& law : Laws()) {
      for (const ParameterInfo& row : law.parameters) {
        const FieldInfo info{.unit = row.unit.rotary,
                             .bounds = {.at_least = row.lower, .at_most = row.upper},
                             .meaning = row.meaning};
        parameters.Add(row.name, Of(0.0, info), info, false);
      }
    }
    schema["properties"]["law"]["enum"] = LawNames();
    schema["properties"]["parameters"].update(MapOf(parameters.properties_));
    return schema;
  }

 private:
  void Add(std::string_view name, const Tree& schema, const FieldInfo& info, bool required) {
    Tree described = Tree::object();
    if (!info.meaning.empty()) described["description"] = info.meaning;
    if (!info.unit.empty()) described["unit"] = info.unit;
    described.update(schema);
    properties_[std::string(name)] = described;
    if (required) required_.emplace_back(name);
  }

  Tree Number(const char* type, const Bounds& bounds) const {
    Tree number{{"type", type}};
    const auto bound = [&](const char* key, double value) {
      if (std::isfinite(value)) number[key] = value;
    };
    bound("minimum", bounds.at_least);
    bound("exclusiveMinimum", bounds.above);
    bound("maximum", bounds.at_most);
    bound("exclusiveMaximum", bounds.below);
    return number;
  }

  // Each type that a member may have.
  Tree Of(double, const FieldInfo& info) const {
    const Tree number = Number("number", info.bounds);
    if (dialect_.drawn) return AnyOf({number, Reference("#/$defs/distribution")});
    return dialect_.written ? Nullable(number) : number;
  }
  Tree Of(int, const FieldInfo& info) const { return Number("integer", info.bounds); }
  Tree Of(std::uint64_t, const FieldInfo&) const { return Number("integer", kNotNegative); }
  Tree Of(bool, const FieldInfo&) const { return {{"type", "boolean"}}; }
  Tree Of(const std::string&, const FieldInfo&) const {
    if (dialect_.texts) return {{"type", {"string", "number", "boolean"}}};
    return {{"type", "string"}};
  }
  Tree Of(const std::filesystem::path&, const FieldInfo&) const { return {{"type", "string"}}; }
  Tree Of(const Tree&, const FieldInfo&) const { return Tree::object(); }
  template <typename E>
  requires std::is_enum_v<E> Tree Of(E, const FieldInfo&)
  const {
    Tree schema;
    for (const Word<E>& word : WordsOf(E{})) schema["enum"].push_back(word.name);
    return schema;
  }

  // What holds others.
  template <Described T>
  Tree Of(const T& value, const FieldInfo&) const {
    return Members(value);
  }
  template <Paired T>
  Tree Of(const T&, const FieldInfo&) const {
    return ListOf({{"type", "string"}});
  }
  template <typename T>
  Tree Of(const std::optional<T>&, const FieldInfo& info) const {
    return Of(T{}, info);
  }
  template <typename T>
  Tree Of(const std::vector<T>&, const FieldInfo& info) const {
    return ListOf(Of(T{}, info));
  }
  template <typename T>
  Tree Of(const std::map<std::string, T>&, const FieldInfo& info) const {
    return {{"type", "object"}, {"additionalProperties", Of(T{}, info)}};
  }
  Tree Of(const std::vector<std::pair<std::string, double>>&, const FieldInfo& info) const {
    return Of(std::map<std::string, double>(), info);
  }
  Tree Of(const std::pair<double, double>&, const FieldInfo& info) const {
    return PairOf(Of(0.0, info));
  }
  Tree Of(const std::array<double, 2>&, const FieldInfo& info) const {
    return PairOf(Of(0.0, info));
  }
  Tree Of(const Eigen::MatrixXd&, const FieldInfo& info) const {
    return ListOf(ListOf(Of(0.0, info)));
  }

  // What has functions of its own that read it.
  Tree Of(const Distribution&, const FieldInfo& info) const {
    return AnyOf({Number("number", info.bounds), Reference("#/$defs/distribution")});
  }
  Tree Of(const Speeds&, const FieldInfo&) const {
    return AnyOf({ListOf(Number("number", kPositive)), Reference("#/$defs/distribution")});
  }
  Tree Of(const Travel&, const FieldInfo&) const {
    return AnyOf({PairOf(Of(0.0, {})), {{"const", "joint_limits"}}});
  }
  Tree Of(const VelocityCorner&, const FieldInfo&) const { return PairOf(Of(0.0, {})); }
  Tree Of(const Friction&, const FieldInfo&) const {
    return Reference("friction.schema.json#/$defs/friction");
  }
  Tree Of(const DrawnFriction&, const FieldInfo&) const {
    Tree drawn = SchemaWriter({.texts = true, .drawn = true}).OfFriction();
    drawn["properties"]["posterior"] = Members(Posterior());
    Tree estimate = MapOf({{"estimate", {{"type", "string"}}}, {"draw", {{"const", "posterior"}}}});
    estimate["required"] = {"estimate"};
    return AnyOf({drawn, {{"type", "string"}}, estimate});
  }
  Tree Of(const GravityModel&, const FieldInfo&) const {
    return {{"type", "object"},
            {"required", {"kind"}},
            {"properties", {{"kind", Of(GravityKind(), {})}}}};
  }
  Tree Of(const SuiteScenario&, const FieldInfo&) const {
    Tree scenario = Reference("scenario.schema.json");
    scenario["properties"] = {{"name", false}, {"seed", false}};
    return scenario;
  }
  Tree Of(const Ladder&, const FieldInfo&) const {
    SchemaWriter members(dialect_);
    std::string variable, unit;
    std::vector<double> values;
    members.Field("variable", &variable, {.meaning = "the entry of the scenario that climbs"});
    members.Field("unit", &unit, {.meaning = "printed with it"});
    members.Field("values", &values,
                  {.meaning = "of the variable, one group of the leaderboard each"});
    members.Add(
        "variants", {{"type", "object"}, {"additionalProperties", {{"type", {"object", "null"}}}}},
        {.meaning = "instead of values: named groups, each with the entries that it changes"},
        false);
    Tree schema = MapOf(members.properties_);
    schema["oneOf"] = {{{"required", {"variable", "values"}}}, {{"required", {"variants"}}}};
    return schema;
  }

  Dialect dialect_;
  Tree properties_ = Tree::object();
  std::vector<std::string> required_;
};

/// A schema as a file.
Tree File(const std::string& name, const char* title, const Tree& schema) {
  Tree file{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
            {"$id", name + ".schema.json"},
            {"title", title},
            {"description", "SI: rad and N.m of rotary joints, m and N of linear ones."}};
  file.update(schema);
  return file;
}

Tree FrictionFile() {
  const Tree friction = Reference("#/$defs/friction");
  const Tree member{
      {"type", "object"}, {"required", {"friction"}}, {"properties", {{"friction", friction}}}};
  return {{"oneOf", {friction, member}}, {"$defs", {{"friction", SchemaWriter({}).OfFriction()}}}};
}

Tree ScenarioFile() {
  Tree scenario = SchemaWriter({.texts = true}).Members(Scenario());
  const Tree range = PairOf({{"type", "number"}});
  Tree words;
  for (const auto& word : WordsOf(Distribution::Kind())) words[std::string(word.name)] = range;
  Tree& distribution = scenario["$defs"]["distribution"] = MapOf(words);
  distribution["minProperties"] = distribution["maxProperties"] = 1;
  return scenario;
}

Tree SuiteFile() {
  Tree suite = SchemaWriter({.texts = true}).Members(Suite());
  suite["oneOf"] = {{{"required", {"identifiers"}}}, {{"required", {"compensators"}}}};
  return suite;
}

/// Members of a struct, or null.
template <class T>
Tree OrNothing(const T& value) {
  return AnyOf({SchemaWriter({.written = true}).Members(value), {{"type", "null"}}});
}

Tree RobotFile() {
  const auto each = [](const Tree& schema) {
    return Tree{{"type", "object"}, {"additionalProperties", schema}};
  };
  const auto described = [](Tree schema, const char* meaning) {
    schema["description"] = meaning;
    return schema;
  };
  const Tree texts = ListOf({{"type", "string"}});
  Tree robot = MapOf({
      {"joints", described(each(Reference("estimate.schema.json")),
                           "by their names, each as estimate.json; friction is null or in "
                           "torque_unit where that is A")},
      {"summary", described(each(SchemaWriter({}).Members(RobotJointSummary())),
                            "of each joint, torques in its torque_unit")},
      {"robot", described({{"type", "string"}}, "file of the description")},
      {"log", described(texts, "files")},
      {"notices", described(texts, "how description and log were understood, one sentence each")},
      {"payload", described(OrNothing(EstimatedParameter()),
                            "mass of a load that the description lacks, where one is shown or "
                            "asked for")},
      {"gravity", described(OrNothing(BaseGravity()),
                            "of a base that does not stand as the description says")},
      {"gravity_taken_off",
       described({{"type", "boolean"}}, "whether the torques were logged without gravity")},
      {"delay", described(OrNothing(EstimatedParameter()),
                          "of all torques against the positions, where the log shows one")},
  });
  robot["required"] = {"joints", "summary"};
  return robot;
}

}  // namespace
}  // namespace warmjoint

int main() {
  using namespace warmjoint;
  const SchemaWriter written({.written = true}), plain({});
  const Tree all{{"friction", File("friction", "Friction of one joint", FrictionFile())},
                 {"estimate", File("estimate", "estimate.json of `warmjoint identify`",
                                   written.Members(Estimate()))},
                 {"robot", File("robot", "robot.json of `warmjoint identify-robot`", RobotFile())},
                 {"scenario", File("scenario", "A scenario", ScenarioFile())},
                 {"suite", File("suite", "A suite", SuiteFile())},
                 {"attributes", plain.Members(PluginAttributes())}};
  fmt::print("{}\n", all.dump());
}
