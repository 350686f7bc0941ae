#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "models/foundation/number_json.h"
#include "models/friction/friction_description.h"
#include "tools/cli/families.h"
#include "tools/terminal/table.h"
#include "tools/terminal/wrap.h"

namespace warmjoint::inline tools {
namespace {

using nlohmann::ordered_json;

ordered_json ParameterJson(const ParameterInfo& info) {
  return {{"name", info.name},
          {"symbol", info.symbol},
          {"unit", {{"rotary", info.unit.rotary}, {"linear", info.unit.linear}}},
          {"lower", NumberOrNull(info.lower)},
          {"upper", NumberOrNull(info.upper)},
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

/// What a friction can carry beside its law.
ordered_json PartsJson() {
  // options of a friction, each a constant of its own
  std::vector<ParameterInfo> options;
  for (const FrictionOption& option : FrictionOptions()) options.push_back(option.info);

  // maps have no table, but quantities, kernels and factors
  ordered_json maps = LawJson(
      "maps",
      "(10)-(16) factor(v) sum_i w_i kappa_i, Gaussian kernels over one to four quantities; the "
      "motor's position is mod(gear position, 2 pi); join any law",
      std::vector<ParameterInfo>{});
  for (const MapQuantity quantity :
       {MapQuantity::position, MapQuantity::motor_position, MapQuantity::velocity,
        MapQuantity::energy, MapQuantity::load}) {
    maps["quantities"].push_back(MapQuantityName(quantity));
  }
  maps["kernels"] = {"normalised", "plain"};
  for (const MapFactor factor : {MapFactor::one, MapFactor::direction, MapFactor::velocity}) {
    maps["factors"].push_back(MapFactorName(factor));
  }

  // each as if it were a law, with its formula
  return {LawJson("thermal", "(20)-(22) F = Fn + sign(v) E, E = k / (1 + s tau) W; joins any law",
                  Thermal::parameters),
          LawJson("thermal.second", "E = E1 + E2, E2 = k2 / (1 + s tau2) W; joins thermal",
                  Thermal::parameters),
          LawJson("options",
                  "F = (kv + b E) v + sign(v) (g + E + c |load|), E settles at k W + kT (Ts - T0); "
                  "join any law, kT and b thermal alone",
                  options),
          maps};
}

std::string Words(const ordered_json& words) {
  return fmt::format("{}", fmt::join(words.get<std::vector<std::string>>(), ", "));
}

std::string ParametersText(const ordered_json& parameters, int width) {
  Table table{{"  parameter", "symbol", "unit", "(linear)", "from", "to", "meaning"}, {}};
  for (const ordered_json& info : parameters) {
    // a bound that does not exist is infinite
    const auto bound = [&](const char* key, const char* none) {
      return info[key].is_null() ? std::string(none) : fmt::format("{}", info[key].get<double>());
    };
    table.rows.push_back({"  " + info["name"].get<std::string>(), info["symbol"],
                          info["unit"]["rotary"], info["unit"]["linear"], bound("lower", "-inf"),
                          bound("upper", "inf"), info["meaning"]});
  }
  return TableToText(table, table.header.size(), width);
}

}  // namespace

/// The laws, and what joins any of them.
nlohmann::ordered_json LawsJson() {
  ordered_json laws = ordered_json::array();
  for (const Law& law : Laws()) laws.push_back(LawJson(law.name, law.equation, law.parameters));
  for (ordered_json& part : PartsJson()) laws.push_back(std::move(part));
  return laws;
}

std::string LawText(const ordered_json& law, int width) {
  // the formula, then the table of its parameters
  std::string text = Wrap(
      fmt::format("{}  {}\n", law["name"].get<std::string>(), law["equation"].get<std::string>()),
      width, 4);
  if (!law["parameters"].empty()) text += ParametersText(law["parameters"], width);
  // maps have words in the place of numbers
  for (const char* key : {"quantities", "kernels", "factors"}) {
    if (law.contains(key)) text += Wrap(fmt::format("  {}: {}\n", key, Words(law[key])), width);
  }
  return text;
}

}  // namespace warmjoint::inline tools
