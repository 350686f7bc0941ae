#include "tools/cli/families.h"

#include <fmt/ranges.h>
#include <warmjoint/friction.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "identification/identifiers/identifier_list.h"
#include "models/foundation/number_json.h"
#include "models/robots/robot_folder.h"
#include "models/robots/robot_list.h"
#include "scenarios/suite.h"
#include "tools/actions/suite_names.h"
#include "tools/terminal/table.h"

namespace warmjoint {
namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

std::string Words(const ordered_json& words) {
  return fmt::format("{}", fmt::join(words.get<std::vector<std::string>>(), ", "));
}

std::string TextOf(const ordered_json& object, const char* key) {
  return object[key].get<std::string>();
}

/// A bound, or what stands for one that does not exist.
std::string BoundText(const ordered_json& bound, const char* none) {
  return bound.is_null() ? std::string(none) : fmt::format("{:.6g}", bound.get<double>());
}

// --- laws ---------------------------------------------------------------------------------------

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

/// The laws, and what joins any of them.
ordered_json LawsJson() {
  ordered_json laws = ordered_json::array();
  for (const Law& law : Laws()) laws.push_back(LawJson(law.name, law.equation, law.parameters));
  for (ordered_json& part : PartsJson()) laws.push_back(std::move(part));
  return laws;
}

std::string LawText(const ordered_json& law) {
  // the formula, then the table of its parameters
  std::string text = fmt::format("{}  {}\n", TextOf(law, "name"), TextOf(law, "equation"));
  Table table{{"  parameter", "symbol", "unit", "(linear)", "from", "to", "meaning"}, {}};
  for (const ordered_json& info : law["parameters"]) {
    table.rows.push_back({"  " + TextOf(info, "name"), info["symbol"], info["unit"]["rotary"],
                          info["unit"]["linear"], BoundText(info["lower"], "-inf"),
                          BoundText(info["upper"], "inf"), info["meaning"]});
  }
  if (!table.rows.empty()) text += TableToText(table, table.header.size());
  // maps have words in the place of numbers
  for (const char* key : {"quantities", "kernels", "factors"}) {
    if (law.contains(key)) text += fmt::format("  {}: {}\n", key, Words(law[key]));
  }
  return text;
}

// --- identifiers --------------------------------------------------------------------------------

ordered_json IdentifiersJson() {
  ordered_json all = ordered_json::array();
  for (const Identifier& identifier : Identifiers()) {
    ordered_json options = ordered_json::array();
    // options in full, of which the short line shows the names
    for (const OptionInfo& option : identifier.options.List()) {
      options.push_back({{"name", option.name},
                         {"default", option.value},
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

std::string IdentifierHead(const ordered_json& identifier) {
  const std::string earlier = identifier.value("earlier_name", "");
  return fmt::format("{}\n    {}{}\n", TextOf(identifier, "name"), TextOf(identifier, "summary"),
                     earlier.empty() ? "" : "; its earlier name is " + earlier);
}

std::string IdentifierLine(const ordered_json& identifier) {
  // what it does, and the names of its options
  std::vector<std::string> options;
  for (const ordered_json& option : identifier["options"]) options.push_back(option["name"]);
  const std::string head = IdentifierHead(identifier);
  return options.empty() ? head : head + fmt::format("    --set {}\n", fmt::join(options, ", "));
}

std::string IdentifierText(const ordered_json& identifier) {
  // what it does, then each option with all that is known of it
  std::string text = IdentifierHead(identifier);
  if (identifier["options"].empty()) return text + "    It has no options.\n";
  text += "\nOptions, each given as --set NAME=VALUE:\n";
  for (const ordered_json& option : identifier["options"]) {
    const std::string initial = TextOf(option, "default");
    text += fmt::format("  {}\n      {}\n      {}\n      default: {}\n", TextOf(option, "name"),
                        TextOf(option, "meaning"), TextOf(option, "allowed"),
                        initial.empty() ? "none" : initial);
  }
  return text;
}

// --- robots -------------------------------------------------------------------------------------

ordered_json RobotsJson() {
  ordered_json all = ordered_json::array();
  for (const RobotInfo& robot : Robots()) {
    // its joints, and which of them the friction file is for
    ordered_json joints = ordered_json::array();
    for (const RobotJoint& joint : robot.joints) {
      joints.push_back({{"name", joint.name},
                        {"kind", NameOf(joint.kind)},
                        {"lower", NumberOrNull(joint.limits.first)},
                        {"upper", NumberOrNull(joint.limits.second)},
                        {"effort", joint.effort},
                        {"speed", joint.speed}});
    }
    all.push_back({{"name", robot.name},
                   {"description", robot.description},
                   {"mjcf", robot.mjcf.string()},
                   {"urdf", robot.urdf.string()},
                   {"joints", joints},
                   {"friction", {{"joint", robot.friction_joint}, {"gear", robot.friction.gear}}}});
  }
  return all;
}

std::string RobotText(const ordered_json& robot) {
  // what it is, then a line for each joint; one that turns for ever has no limits
  const std::string head =
      fmt::format("{}  {}\n", TextOf(robot, "name"), TextOf(robot, "description"));
  Table table{{"  joint", "unit", "from", "to", "speed", "effort", "friction file"}, {}};
  const ordered_json& friction = robot["friction"];
  for (const ordered_json& joint : robot["joints"]) {
    const JointKind kind = joint["kind"] == "linear" ? JointKind::linear : JointKind::rotary;
    const std::string unit(kPositionUnit.For(kind));
    table.rows.push_back(
        {"  " + TextOf(joint, "name"), unit, BoundText(joint["lower"], "-inf"),
         BoundText(joint["upper"], "inf"),
         fmt::format("{:.4g} {}/s", joint["speed"].get<double>(), unit),
         fmt::format("{:g} {}", joint["effort"].get<double>(), kTorqueUnit.For(kind)),
         joint["name"] == friction["joint"]
             ? fmt::format("gear {:g}", friction["gear"].get<double>())
             : ""});
  }
  return head + TableToText(table, 2);
}

// --- suites -------------------------------------------------------------------------------------

ordered_json SuitesJson() {
  ordered_json suites = ordered_json::array();
  for (const std::string& name : SuiteNames()) {
    // read in full: its variants and labels come of reading it
    const std::string file = SuiteFile(name);
    const Suite suite = ReadSuite(file);
    ordered_json identifiers = ordered_json::array();
    for (const SuiteIdentifier& one : suite.identifiers) identifiers.push_back(one.label);
    suites.push_back({{"name", suite.name},
                      {"question", suite.question},
                      {"realizations", suite.realizations},
                      {"variants", suite.variants()},
                      {"identifiers", identifiers},
                      {"file", file}});
  }
  return suites;
}

std::string SuiteLine(const ordered_json& suite) {
  return fmt::format("{}\n    {}\n", TextOf(suite, "name"), TextOf(suite, "question"));
}

std::string SuiteText(const ordered_json& suite) {
  const int variants = suite["variants"].get<int>();
  return SuiteLine(suite) +
         fmt::format("    {} realizations of {}\n    identifiers: {}\n    {}\n",
                     suite["realizations"].get<int>(),
                     variants == 1 ? std::string("one scenario")
                                   : fmt::format("each of {} scenarios", variants),
                     Words(suite["identifiers"]), fs::proximate(TextOf(suite, "file")).string());
}

}  // namespace

const std::vector<Family>& Families() {
  static const std::vector<Family> families{
      {"laws", LawsJson, LawNames, LawText, LawText},
      {"identifiers", IdentifiersJson, IdentifierNames, IdentifierLine, IdentifierText},
      {"robots", RobotsJson, RobotNames, RobotText, RobotText},
      {"suites", SuitesJson, SuiteNames, SuiteLine, SuiteText},
  };
  return families;
}

}  // namespace warmjoint
