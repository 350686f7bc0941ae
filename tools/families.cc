#include "tools/families.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "identification/identifier.h"
#include "models/friction/law.h"
#include "models/friction/thermal.h"
#include "scenarios/suite.h"
#include "tools/leaderboard/table.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;
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

/// The laws, and the thermal state that joins any of them.
ordered_json LawsJson() {
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

/// Entries of a folder of the project in the order of their names.
std::vector<fs::path> Entries(const fs::path& folder) {
  std::vector<fs::path> entries;
  if (!fs::is_directory(folder)) return entries;
  for (const auto& entry : fs::directory_iterator(folder)) entries.push_back(entry.path());
  std::sort(entries.begin(), entries.end());
  return entries;
}

/// A robot is a folder with an MJCF of its name.
ordered_json RobotsJson() {
  ordered_json robots = ordered_json::array();
  for (const fs::path& folder : Entries(fs::path(WARMJOINT_SOURCE_DIR) / "models/robots")) {
    const fs::path mjcf = folder / (folder.filename().string() + ".xml");
    if (!fs::exists(mjcf)) continue;
    robots.push_back({{"name", folder.filename().string()}, {"mjcf", mjcf.string()}});
  }
  return robots;
}

ordered_json SuitesJson() {
  ordered_json suites = ordered_json::array();
  for (const fs::path& file : Entries(fs::path(WARMJOINT_SOURCE_DIR) / "scenarios/suites")) {
    if (file.extension() != ".yaml") continue;
    const Suite suite = ReadSuite(file);
    suites.push_back({{"name", suite.name},
                      {"question", suite.question},
                      {"realizations", suite.realizations},
                      {"file", file.string()}});
  }
  return suites;
}

std::string RobotsText() {
  Table table{{"robot", "MJCF"}, {}};
  for (const ordered_json& robot : RobotsJson())
    table.rows.push_back({robot["name"], robot["mjcf"]});
  return TableToText(table, 2);
}

std::string SuitesText() {
  std::string text;
  for (const ordered_json& suite : SuitesJson()) {
    text += fmt::format("{}  {} realizations  {}\n    {}\n", suite["name"].get<std::string>(),
                        suite["realizations"].get<int>(), suite["file"].get<std::string>(),
                        suite["question"].get<std::string>());
  }
  return text;
}

}  // namespace

const std::vector<Family>& Families() {
  static const std::vector<Family> families{
      {"laws", LawsJson, LawsText},
      {"identifiers", IdentifiersJson, IdentifiersText},
      {"robots", RobotsJson, RobotsText},
      {"suites", SuitesJson, SuitesText},
  };
  return families;
}

}  // namespace warmjoint
