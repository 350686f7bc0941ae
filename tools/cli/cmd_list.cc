// warmjoint list laws|identifiers|compensators|robots|library|suites [NAME]: what there is to choose from.
#include <fmt/ranges.h>
#include <warmjoint/friction.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "identification/identifiers/identifier_list.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/node.h"
#include "models/robots/robot_folder.h"
#include "scenarios/suite.h"
#include "tools/actions/run_task.h"
#include "tools/cli/command.h"
#include "tools/cli/typed_options.h"
#include "tools/compensate/arms/arm_list.h"
#include "tools/identify/catalogue.h"
#include "tools/terminal/say.h"

namespace warmjoint {
namespace {

/// A family. Each member is an object with `name`; its text is made from that object alone.
struct Family {
  std::string name;
  nlohmann::ordered_json (*members)();
  std::vector<std::string> (*names)();  // the same names, without reading more than they need
  std::string (*line)(const nlohmann::ordered_json& member);  // in the list of all
  std::string (*page)(const nlohmann::ordered_json& member);  // by itself
};

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

std::string LawText(const ordered_json& law) {
  // the formula, then the table of its parameters
  std::string text = fmt::format("{}  {}\n", TextOf(law, "name"), TextOf(law, "equation"));
  Table table{{"  parameter", "symbol", "unit", "(linear)", "from", "to", "meaning"}, {}};
  for (const ordered_json& info : law["parameters"]) {
    table.rows.push_back({"  " + TextOf(info, "name"), info["symbol"], info["unit"]["rotary"],
                          info["unit"]["linear"], BoundText(info["lower"], "-inf"),
                          BoundText(info["upper"], "inf"), info["meaning"]});
  }
  if (!table.rows.empty()) text += TableToText(table, table.header.size(), PageOf(stdout));
  // maps have words in the place of numbers
  for (const char* key : {"quantities", "kernels", "factors"}) {
    if (law.contains(key)) text += fmt::format("  {}: {}\n", key, Words(law[key]));
  }
  return text;
}

// --- identifiers --------------------------------------------------------------------------------

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

// --- compensators -------------------------------------------------------------------------------

std::vector<std::string> CompensatorNames() {
  std::vector<std::string> names;
  for (const CompensatorArm& arm : CompensatorArms()) names.push_back(arm.name);
  return names;
}

ordered_json CompensatorsJson() {
  ordered_json all = ordered_json::array();
  for (const CompensatorArm& arm : CompensatorArms()) {
    all.push_back(
        {{"name", arm.name}, {"summary", arm.summary}, {"options", OptionsJson(arm.options)}});
  }
  return all;
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
                   {"friction",
                    {{"joint", robot.friction_joint},
                     {"gear", robot.friction.gear},
                     {"origin", "invented"}}}});
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
             ? fmt::format("{}, gear {:g}", TextOf(friction, "origin"),
                           friction["gear"].get<double>())
             : ""});
  }
  return head + TableToText(table, 2, PageOf(stdout));
}

// --- library ------------------------------------------------------------------------------------

/// The friction at the middle one of the speeds that the card holds, with its interval.
std::string FrictionText(const ordered_json& joint) {
  const ordered_json& known = joint["friction"];
  if (known.empty()) return "";
  const ordered_json& one = known[known.size() / 2];
  const double half = (one["interval95"][1].get<double>() - one["interval95"][0].get<double>()) / 2;
  return fmt::format("{:.3g} +- {:.2g} {} at {:.3g} {}", one["value"].get<double>(), half,
                     TextOf(joint, "unit"), one["speed"].get<double>(),
                     TextOf(joint, "speed_unit"));
}

std::string MachineText(const ordered_json& machine) {
  const std::string head =
      fmt::format("{}  {}\n", TextOf(machine, "name"), TextOf(machine, "machine"));
  Table table{{"  joint", "verdict", "friction"}, {}};
  for (const ordered_json& joint : machine["joints"]) {
    table.rows.push_back(
        {"  " + TextOf(joint, "name"), TextOf(joint, "status"), FrictionText(joint)});
  }
  return head + TableToText(table, table.header.size(), PageOf(stdout));
}

std::string MachinePage(const ordered_json& machine) {
  // the table, then where it comes from, what refuses a joint, and what it is not good for
  std::string text = MachineText(machine);
  for (const ordered_json& source : machine["source"]) {
    const std::string commit = TextOf(source, "commit");
    text += fmt::format("  from {}{}{}, licence: {}\n", TextOf(source, "repository"),
                        commit.empty() ? "" : " @ ", commit, TextOf(source, "licence"));
  }
  for (const ordered_json& joint : machine["joints"]) {
    const std::string said = joint.value("message", "");
    if (!said.empty()) text += fmt::format("  {}: {}\n", TextOf(joint, "name"), said);
  }
  for (const ordered_json& limit : machine["not_for"])
    text += fmt::format("  not for {}\n", limit.get<std::string>());
  return text + fmt::format("\nwarmjoint attach MODEL --friction library:{} -o warm.xml\n",
                            TextOf(machine, "name"));
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

/// laws, identifiers, compensators, robots, library, suites.
const std::vector<Family>& Families() {
  static const std::vector<Family> families{
      {"laws", LawsJson, LawNames, LawText, LawText},
      {"identifiers", IdentifiersJson, IdentifierNames, IdentifierLine, IdentifierText},
      {"compensators", CompensatorsJson, CompensatorNames, IdentifierLine, IdentifierText},
      {"robots", RobotsJson, RobotNames, RobotText, RobotText},
      {"library", LibraryJson, MachineNames, MachineText, MachinePage},
      {"suites", SuitesJson, SuiteNames, SuiteLine, SuiteText},
  };
  return families;
}

struct ListArguments {
  std::string family;
  std::string member;
  std::string format = "text";
};

/// The member of that name; all of them where it is empty.
nlohmann::ordered_json Members(const Family& family, const std::string& name) {
  if (name.empty()) return family.members();
  // one by its name; what is none is refused with the nearest
  std::vector<std::string> names;
  for (nlohmann::ordered_json& member : family.members()) {
    if (member["name"] == name || member.value("earlier_name", "") == name)
      return nlohmann::ordered_json::array({std::move(member)});
    names.push_back(member["name"]);
  }
  Refuse({"warmjoint list " + family.name}, "there is no '{}'{}", Excerpt(name),
         Suggestion(name, names));
}

std::vector<std::string> Names(const Family& family, const std::string& name) {
  // all of them are known without their contents
  if (name.empty()) return family.names();
  return {Members(family, name).front()["name"]};
}

std::string Text(const Family& family, const ListArguments& arguments) {
  // all in short, or one in full
  std::string text;
  for (const nlohmann::ordered_json& member : Members(family, arguments.member)) {
    if (!text.empty()) text += "\n";
    text += arguments.member.empty() ? family.line(member) : family.page(member);
  }
  return text;
}

ExitStatus List(const ListArguments& arguments) {
  // the chosen family in the chosen form
  for (const Family& family : Families()) {
    if (family.name != arguments.family) continue;
    if (arguments.format == "names") {
      fmt::print("{}\n", fmt::join(Names(family, arguments.member), "\n"));
    } else if (arguments.format == "json") {
      fmt::print("{}\n", Members(family, arguments.member).dump(2));
    } else {
      Say(stdout, "{}", Text(family, arguments));
    }
  }
  return ExitStatus::done;
}

}  // namespace

Command AddListCommand(CLI::App& program) {
  auto arguments = std::make_shared<ListArguments>();
  CLI::App* parser = program.add_subcommand(
      "list", "What there is: laws, identifiers, compensators, robots, library, suites");
  GiveExample(*parser, "warmjoint list identifiers energy-ml");

  std::vector<std::string> names;
  for (const Family& family : Families()) names.push_back(family.name);
  AddChoice(*parser, "FAMILY", arguments->family, names, fmt::format("{}", fmt::join(names, ", ")))
      ->required();
  AddValue(*parser, "NAME", "MEMBER", arguments->member,
           "one member alone, with its options in full");
  AddChoice(*parser, "--format", arguments->format, {"text", "json", "names"},
            "names: one name a line");
  return {parser, [arguments] { return List(*arguments); }};
}

}  // namespace warmjoint
