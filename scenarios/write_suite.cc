#include <fmt/format.h>

#include "scenarios/suite.h"
#include "scenarios/write_scenario.h"

namespace warmjoint::inline scenarios {
namespace {

/// Collects "key: value" lines.
class Lines {
 public:
  void Add(std::string_view indent, std::string_view key, std::string_view value) {
    text_ += fmt::format("{}{}: {}\n", indent, key, value);
  }
  void Begin(std::string_view indent, std::string_view key) {
    text_ += fmt::format("{}{}:\n", indent, key);
  }
  void Append(const std::string& text) { text_ += text; }
  std::string Take() { return std::move(text_); }

 private:
  std::string text_;
};

std::string ClaimToYaml(const Claim& claim) {
  std::string yaml = "{source: " + QuotedYaml(claim.source);
  for (const auto& [name, value] : claim.figures) yaml += fmt::format(", {}: {}", name, value);
  return yaml + "}";
}

void AddIdentifier(const SuiteIdentifier& identifier, Lines& lines) {
  lines.Add("  - ", "name", QuotedYaml(identifier.name));
  lines.Add("    ", "label", QuotedYaml(identifier.label));
  if (!identifier.options.empty()) lines.Begin("    ", "options");
  for (const auto& [name, value] : identifier.options) {
    lines.Add("      ", QuotedYaml(name), QuotedYaml(value));
  }
  if (identifier.claim) lines.Add("    ", "claim", ClaimToYaml(*identifier.claim));
}

void AddLadder(const Ladder& ladder, Lines& lines) {
  lines.Begin("", "ladder");
  if (!ladder.unit.empty()) lines.Add("  ", "unit", QuotedYaml(ladder.unit));
  // numbers of one entry, or named changes of several
  if (!ladder.variable.empty()) {
    std::string values;
    for (const Variant& variant : ladder.variants) {
      values += fmt::format("{}{}", values.empty() ? "" : ", ", variant.value.value_or(0));
    }
    lines.Add("  ", "variable", QuotedYaml(ladder.variable));
    lines.Add("  ", "values", "[" + values + "]");
    return;
  }
  lines.Begin("  ", "variants");
  for (const Variant& variant : ladder.variants) {
    // a variant without changes is an empty map
    if (variant.settings.empty()) lines.Add("    ", QuotedYaml(variant.name), "{}");
    if (!variant.settings.empty()) lines.Begin("    ", QuotedYaml(variant.name));
    for (const Setting& setting : variant.settings) {
      lines.Add("      ", QuotedYaml(setting.key), setting.value);
    }
  }
}

}  // namespace

std::string SuiteToYaml(const Suite& suite) {
  Lines lines;
  lines.Add("", "name", QuotedYaml(suite.name));
  lines.Add("", "question", QuotedYaml(suite.question));
  lines.Add("", "realizations", std::to_string(suite.realizations));
  lines.Add("", "seed", std::to_string(suite.scenario.seed));
  lines.Begin("", "scenario");
  lines.Append(ScenarioPartToYaml(suite.scenario, "  "));
  if (suite.ladder) AddLadder(*suite.ladder, lines);
  lines.Begin("", "identifiers");
  for (const SuiteIdentifier& identifier : suite.identifiers) AddIdentifier(identifier, lines);
  return lines.Take();
}

}  // namespace warmjoint::inline scenarios
