#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "identification/identifiers/identifier_list.h"
#include "tools/cli/families.h"
#include "tools/terminal/wrap.h"

namespace warmjoint::inline tools {

using nlohmann::ordered_json;

ordered_json IdentifiersJson() {
  ordered_json all = ordered_json::array();
  for (const Identifier& identifier : Identifiers()) {
    ordered_json options = ordered_json::array();
    // options in full, of which the short line shows the names
    for (const OptionInfo& option : identifier.options) {
      options.push_back({{"name", option.name},
                         {"default", option.default_value},
                         {"allowed", option.allowed},
                         {"meaning", option.meaning}});
    }
    ordered_json& one = all.emplace_back(ordered_json{{"name", identifier.name}});
    if (!identifier.earlier_name.empty()) one["earlier_name"] = identifier.earlier_name;
    one["summary"] = identifier.summary;
    one["options"] = std::move(options);
  }
  return all;
}

std::vector<std::string> IdentifierNames() {
  std::vector<std::string> names;
  for (const Identifier& identifier : Identifiers()) names.push_back(identifier.name);
  return names;
}

namespace {

std::string Head(const ordered_json& identifier) {
  const std::string earlier = identifier.value("earlier_name", "");
  return fmt::format("{}\n    {}{}\n", identifier["name"].get<std::string>(),
                     identifier["summary"].get<std::string>(),
                     earlier.empty() ? "" : "; its earlier name is " + earlier);
}

/// "one of coulomb, asymmetric", "number > 0", "text".
std::string Allowed(const std::string& allowed) {
  if (allowed.find('|') == std::string::npos) return allowed;
  std::string words = "one of ";
  for (const char c : allowed) words += c == '|' ? std::string(", ") : std::string(1, c);
  return words;
}

}  // namespace

std::string IdentifierLine(const ordered_json& identifier, int width) {
  // what it does, and the names of its options
  std::vector<std::string> options;
  for (const ordered_json& option : identifier["options"]) options.push_back(option["name"]);
  std::string text = Wrap(Head(identifier), width, 0);
  if (options.empty()) return text;
  return text + Wrap(fmt::format("    --set {}\n", fmt::join(options, ", ")), width, 6);
}

std::string IdentifierText(const ordered_json& identifier, int width) {
  // what it does, then each option with all that is known of it
  std::string text = Wrap(Head(identifier), width, 0);
  if (identifier["options"].empty()) return text + "    It has no options.\n";
  text += "\nOptions, each given as --set NAME=VALUE:\n";
  for (const ordered_json& option : identifier["options"]) {
    const auto member = [&](const char* key) { return option[key].get<std::string>(); };
    const std::string initial = member("default").empty() ? "none" : member("default");
    text += Wrap(fmt::format("  {}\n      {}\n      {}\n      default: {}\n", member("name"),
                             member("meaning"), Allowed(member("allowed")), initial),
                 width, 2);
  }
  return text;
}

}  // namespace warmjoint::inline tools
