#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "identification/identifiers/identifier_list.h"
#include "tools/board/table.h"
#include "tools/cli/families.h"

namespace warmjoint::inline tools {

using nlohmann::ordered_json;

ordered_json IdentifiersJson() {
  ordered_json all = ordered_json::array();
  for (const Identifier& identifier : Identifiers()) {
    ordered_json options = ordered_json::array();
    for (const OptionInfo& option : identifier.options) {
      options.push_back({{"name", option.name},
                         {"default", option.default_value},
                         {"allowed", option.allowed},
                         {"meaning", option.meaning}});
    }
    all.push_back(
        {{"name", identifier.name}, {"summary", identifier.summary}, {"options", options}});
  }
  return all;
}

std::string IdentifiersText() {
  std::string text;
  for (const Identifier& identifier : Identifiers()) {
    text += fmt::format("{}  {}\n", identifier.name, identifier.summary);
    Table table{{"  --set", "default", "allowed", "meaning"}, {}};
    for (const OptionInfo& option : identifier.options) {
      table.rows.push_back(
          {"  " + option.name, option.default_value, option.allowed, option.meaning});
    }
    text += TableToText(table, table.header.size()) + "\n";
  }
  return text;
}

}  // namespace warmjoint::inline tools
