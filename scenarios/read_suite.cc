#include <algorithm>
#include <filesystem>

#include "models/foundation/atomic_file.h"
#include "models/foundation/excerpt.h"
#include "scenarios/parse_suite.h"
#include "scenarios/read_scenario.h"
#include "scenarios/write_scenario.h"

namespace warmjoint::inline scenarios {
namespace {

constexpr std::size_t kMostVariants = 1000;

Claim ReadClaim(const YamlValue& value) {
  std::vector<std::string> keys(kClaimFigures.begin(), kClaimFigures.end());
  keys.emplace_back("source");
  value.RequireKeys(keys);
  Claim claim;
  claim.source = value.Require("source", "say who claims it").Text();
  for (const char* name : kClaimFigures) {
    if (const auto figure = value.Find(name)) {
      claim.figures[name] = figure->Number(Bound::not_negative);
    }
  }
  return claim;
}

SuiteIdentifier ReadIdentifier(const YamlValue& value) {
  value.RequireKeys({"name", "label", "options", "claim", "command"});
  SuiteIdentifier identifier;
  identifier.name = value.Require("name", "name an identifier (`list identifiers`)").Text();
  // the name serves as a label where there is none
  const auto label = value.Find("label");
  identifier.label = label ? label->Text() : identifier.name;
  if (const auto options = value.Find("options")) {
    options->RequireDistinctKeys();
    for (const std::string& name : options->Keys()) {
      if (const auto option = options->Find(name)) identifier.options[name] = option->Text();
    }
  }
  if (const auto claim = value.Find("claim")) identifier.claim = ReadClaim(*claim);

  // a command of the user's stands in the place of an identifier of the list
  if (const auto command = value.Find("command")) {
    if (identifier.options.contains("command")) {
      Refuse(command->place(), "{} stands in options too; keep one", command->key());
    }
    identifier.name = kExternal;
    identifier.options["command"] = command->Text();
  }
  return identifier;
}

std::vector<SuiteIdentifier> ReadIdentifiers(const YamlValue& value) {
  std::vector<SuiteIdentifier> identifiers;
  for (const YamlValue& entry : value.List("a list of identifiers")) {
    const SuiteIdentifier identifier = ReadIdentifier(entry);
    // labels tell identifiers apart
    for (const SuiteIdentifier& other : identifiers) {
      if (other.label != identifier.label) continue;
      Refuse(entry.place(), "two identifiers have the label '{}'; give each its own `label`",
             Excerpt(identifier.label));
    }
    identifiers.push_back(identifier);
  }
  return identifiers;
}

std::vector<Variant> ReadValues(const YamlValue& values, const std::string& variable) {
  std::vector<Variant> variants;
  for (const YamlValue& value : values.List("a list of numbers")) {
    const double number = value.Number();
    const std::string text = fmt::format("{}", number);
    variants.push_back({text, number, {{variable, text}}});
  }
  return variants;
}

std::vector<Variant> ReadVariants(const YamlValue& value) {
  if (!value.IsMap()) value.RefuseValue("a map from names to changed entries");
  value.RequireDistinctKeys();
  std::vector<Variant> variants;
  for (const std::string& name : value.Keys()) {
    Variant variant{name, std::nullopt, {}};
    // an empty variant is the scenario as it is
    if (const auto changes = value.Find(name)) {
      changes->RequireDistinctKeys();
      // each changed entry, with its value as YAML
      for (const auto& entry : changes->node()) {
        variant.settings.push_back({entry.first.Scalar(), FlowYaml(entry.second)});
      }
    }
    variants.push_back(variant);
  }
  return variants;
}

Ladder ReadLadder(const YamlValue& value) {
  value.RequireKeys({"variable", "unit", "values", "variants"});
  // numbers of one entry, or named changes of several
  const auto values = value.Find("values");
  const auto variants = value.Find("variants");
  if (bool(values) == bool(variants)) {
    Refuse(value.place(), "{} must have one of: variable and values; variants", value.key());
  }

  Ladder ladder;
  if (const auto unit = value.Find("unit")) ladder.unit = unit->Text();
  if (values) {
    ladder.variable = value.Require("variable", "name the entry that the values are for").Text();
    ladder.variants = ReadValues(*values, ladder.variable);
  } else {
    ladder.variants = ReadVariants(*variants);
  }
  // each variant costs all its realizations
  if (ladder.variants.size() > kMostVariants) {
    Refuse(value.place(), "{} has {} variants; {} at most: make suites of its parts", value.key(),
           ladder.variants.size(), kMostVariants);
  }
  return ladder;
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

Suite ReadSuite(const std::string& path) {
  return ParseSuite(ReadWholeFile(path, kLargestDocument), path);
}

Suite ParseSuite(const std::string& text, const std::string& file) {
  const YamlValue document = YamlValue::Parse(text, file);
  document.RequireKeys(
      {"name", "question", "realizations", "seed", "scenario", "ladder", "identifiers"});

  // what the suite is
  Suite suite;
  suite.name = std::filesystem::path(file).stem().string();
  if (const auto name = document.Find("name")) suite.name = name->Text();
  suite.question = document.Require("question", "say in a sentence what the suite asks").Text();
  if (const auto realizations = document.Find("realizations")) {
    suite.realizations = static_cast<int>(realizations->Whole(1, kMostRealizations));
  }

  // one seed and one name for all of it
  const YamlValue scenario = document.Require("scenario", "give the scenario to realize");
  for (const char* key : {"seed", "name"}) {
    const auto own = scenario.IsMap() ? scenario.Find(key) : std::nullopt;
    if (own) Refuse(own->place(), "{} belongs to the suite; move it to the top", own->key());
  }
  suite.scenario = ReadScenarioValue(scenario, suite.name);
  if (const auto seed = document.Find("seed")) {
    suite.scenario.seed = seed->Seed();
  }

  // what varies, and who answers
  if (const auto ladder = document.Find("ladder")) {
    suite.ladder = ReadLadder(*ladder);
    CheckVariants(suite, ladder->place());
  }
  suite.identifiers =
      ReadIdentifiers(document.Require("identifiers", "list at least one identifier"));
  return suite;
}

}  // namespace warmjoint::inline scenarios
