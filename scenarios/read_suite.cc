#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/serialize.h"
#include "scenarios/read_scenario.h"
#include "scenarios/suite.h"
#include "scenarios/yaml.h"

namespace warmjoint {
namespace {

constexpr std::size_t kMostVariants = 1000;

std::vector<Variant> ReadValues(const Node& values, const std::string& variable) {
  std::vector<Variant> variants;
  for (const Node& value : values.List("a list of numbers")) {
    const double number = value.Number();
    const std::string text = fmt::format("{}", number);
    variants.push_back({text, number, {{variable, text}}});
  }
  return variants;
}

std::vector<Variant> ReadVariants(const Node& node) {
  if (!node.IsMap()) node.RefuseValue("a map from names to changed entries");
  std::vector<Variant> variants;
  for (const std::string& name : node.Keys()) {
    Variant variant{name, std::nullopt, {}};
    // an empty variant is the scenario as it is; a null takes an entry out
    if (const auto changes = node.Find(name)) {
      for (const std::string& key : changes->Keys()) {
        variant.settings.push_back({key, ToFlowYaml(changes->tree()[key])});
      }
    }
    variants.push_back(variant);
  }
  return variants;
}

/// Labels tell identifiers apart.
void CheckLabels(const Suite& suite, const Node& document) {
  std::vector<std::string> labels;
  const char* const key = suite.contest == Contest::identifiers ? "identifiers" : "compensators";
  const std::vector<Node> entries = document.Require(key, "").List("a list of who answers");
  for (const SuiteIdentifier& one : suite.identifiers) {
    if (std::ranges::find(labels, one.label) != labels.end()) {
      Refuse(entries[labels.size()].place(),
             "two of them have the label '{}'; give each its own `label`", Excerpt(one.label));
    }
    labels.push_back(one.label);
  }
}

/// Applies each variant once, so that a mistake shows before anything runs.
void CheckVariants(const Suite& suite, const Place& place) {
  for (int i = 0; i < suite.variants(); ++i) {
    try {
      VariantScenario(suite, i);
    } catch (const BadInput& error) {
      Refuse(place, "variant '{}': {}",
             Excerpt(suite.ladder->variants[static_cast<size_t>(i)].name), error.what());
    }
  }
}

}  // namespace

void ReadValue(const Node& node, Ladder* value, const FieldInfo&) {
  node.RequireKeys({"variable", "unit", "values", "variants"});
  // numbers of one entry, or named changes of several
  const auto values = node.Find("values");
  const auto variants = node.Find("variants");
  if (bool(values) == bool(variants)) {
    Refuse(node.place(), "{} must have one of: variable and values; variants", node.key());
  }
  if (const auto unit = node.Find("unit")) value->unit = unit->Text();
  if (values) {
    value->variable = node.Require("variable", "name the entry that the values are for").Text();
    value->variants = ReadValues(*values, value->variable);
  } else {
    value->variants = ReadVariants(*variants);
  }
  // each variant costs all its realizations
  if (value->variants.size() <= kMostVariants) return;
  Refuse(node.place(), "{} has {} variants; {} at most: make suites of its parts", node.key(),
         value->variants.size(), kMostVariants);
}

Tree WriteValue(const Ladder& value) {
  Tree tree = Tree::object();
  if (!value.unit.empty()) tree["unit"] = value.unit;
  if (!value.variable.empty()) {
    tree["variable"] = value.variable;
    for (const Variant& variant : value.variants)
      tree["values"].push_back(variant.value.value_or(0));
    return tree;
  }
  // changed entries are YAML
  for (const Variant& variant : value.variants) {
    Tree& changes = tree["variants"][variant.name] = Tree::object();
    for (const Setting& setting : variant.settings) {
      changes[setting.key] = ParseYaml(setting.value, variant.name).tree();
    }
  }
  return tree;
}

void ReadValue(const Node& node, SuiteScenario* value, const FieldInfo&) {
  for (const char* key : {"seed", "name"}) {
    const auto own = node.Find(key);
    if (own) Refuse(own->place(), "{} belongs to the suite; move it to the top", own->key());
  }
  value->scenario = ScenarioFrom(node, "");
}

Tree WriteValue(const SuiteScenario& value) {
  Tree tree = WriteFields(value.scenario);
  tree.erase("name");
  tree.erase("seed");
  return tree;
}

Suite ReadSuite(const std::string& path) {
  return ParseSuite(ReadWholeFile(path, kLargestDocument), path);
}

Suite ParseSuite(const std::string& text, const std::string& file) {
  const Node document = ParseYaml(text, file);
  Suite suite;
  suite.name = std::filesystem::path(file).stem().string();
  ReadFields(document, &suite);
  CheckLabels(suite, document);
  if (const auto ladder = document.Find("ladder")) CheckVariants(suite, ladder->place());
  return suite;
}

std::string SuiteToYaml(const Suite& suite) { return ToYaml(WriteFields(suite)); }

Scenario VariantScenario(const Suite& suite, int variant) {
  if (!suite.ladder) return suite.scenario;
  const Variant& rung = suite.ladder->variants.at(static_cast<size_t>(variant));
  return WithSettings(suite.scenario, rung.settings);
}

}  // namespace warmjoint
