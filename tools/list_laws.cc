#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "models/friction/law.h"
#include "models/friction/thermal.h"
#include "tools/families.h"
#include "tools/leaderboard/table.h"

namespace warmjoint {
namespace {

using nlohmann::ordered_json;

ordered_json Bound(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

ordered_json ParameterJson(const ParameterInfo& info) {
  return {{"name", info.name},
          {"symbol", info.symbol},
          {"unit", {{"rotary", info.unit.rotary}, {"linear", info.unit.linear}}},
          {"lower", Bound(info.lower)},
          {"upper", Bound(info.upper)},
          {"default", info.default_value},
          {"meaning", info.meaning}};
}

template <typename Parameters>
ordered_json LawJson(std::string_view name, std::string_view equation,
                     const Parameters& parameters) {
  ordered_json law{{"name", name}, {"equation", equation}, {"parameters", ordered_json::array()}};
  for (const ParameterInfo& info : parameters) law["parameters"].push_back(ParameterJson(info));
  return law;
}

}  // namespace

/// The laws, and the thermal state that joins any of them.
nlohmann::ordered_json LawsJson() {
  ordered_json laws = ordered_json::array();
  for (const Law& law : Laws()) laws.push_back(LawJson(law.name, law.equation, law.parameters));
  laws.push_back(LawJson("thermal",
                         "(20)-(22) F = Fn + sign(v) E, E = k / (1 + s tau) W; joins any law",
                         Thermal::parameters));
  return laws;
}

std::string LawsText() {
  std::string text;
  for (const ordered_json& law : LawsJson()) {
    text +=
        fmt::format("{}  {}\n", law["name"].get<std::string>(), law["equation"].get<std::string>());
    Table table{{"  parameter", "symbol", "unit", "(linear)", "from", "to", "meaning"}, {}};
    for (const ordered_json& info : law["parameters"]) {
      const auto bound = [&](const char* key, const char* none) {
        return info[key].is_null() ? std::string(none) : fmt::format("{}", info[key].get<double>());
      };
      table.rows.push_back({"  " + info["name"].get<std::string>(), info["symbol"],
                            info["unit"]["rotary"], info["unit"]["linear"], bound("lower", "-inf"),
                            bound("upper", "inf"), info["meaning"]});
    }
    text += TableToText(table, table.header.size()) + "\n";
  }
  return text;
}

}  // namespace warmjoint
