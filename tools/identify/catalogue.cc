#include "tools/identify/catalogue.h"

#include <warmjoint/friction.h>

#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "identification/identifiers/identifier_list.h"
#include "models/foundation/data_folder.h"
#include "models/foundation/node.h"

namespace warmjoint {
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
  for (const auto& word : WordsOf(MapQuantity())) maps["quantities"].push_back(word.name);
  for (const auto& word : WordsOf(KernelKind())) maps["kernels"].push_back(word.name);
  for (const auto& word : WordsOf(MapFactor())) maps["factors"].push_back(word.name);

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

}  // namespace

ordered_json LawsJson() {
  ordered_json laws = ordered_json::array();
  for (const Law& law : Laws()) laws.push_back(LawJson(law.name, law.equation, law.parameters));
  for (ordered_json& part : PartsJson()) laws.push_back(std::move(part));
  return laws;
}

ordered_json OptionsJson(const Options& options) {
  ordered_json all = ordered_json::array();
  for (const OptionInfo& option : options.List()) {
    all.push_back({{"name", option.name},
                   {"default", option.value},
                   {"allowed", option.allowed},
                   {"meaning", option.meaning}});
  }
  return all;
}

ordered_json IdentifiersJson() {
  ordered_json all = ordered_json::array();
  for (const Identifier& identifier : Identifiers()) {
    ordered_json& one = all.emplace_back(ordered_json{{"name", identifier.name}});
    if (!identifier.earlier_name.empty()) one["earlier_name"] = identifier.earlier_name;
    one["summary"] = identifier.summary;
    one["options"] = OptionsJson(identifier.options);
  }
  return all;
}

ordered_json LibraryJson() {
  ordered_json machines = ordered_json::array();
  for (const std::string& name : MachineNames()) {
    ordered_json card = ReadJsonFile(DataFolder() / "models" / "library" / name / "card.json");
    card["name"] = name;
    machines.push_back(std::move(card));
  }
  return machines;
}

}  // namespace warmjoint
