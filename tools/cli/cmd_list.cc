// warmjoint list laws|identifiers|robots|suites [NAME]: what there is to choose from.
#include <fmt/ranges.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/nearest_name.h"
#include "tools/cli/command.h"
#include "tools/cli/families.h"
#include "tools/cli/typed_options.h"

namespace warmjoint {
namespace {

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
      fmt::print("{}", Text(family, arguments));
    }
  }
  return ExitStatus::done;
}

}  // namespace

Command AddListCommand(CLI::App& program) {
  auto arguments = std::make_shared<ListArguments>();
  CLI::App* parser =
      program.add_subcommand("list", "What there is: laws, identifiers, robots, suites");

  std::vector<std::string> names;
  for (const Family& family : Families()) names.push_back(family.name);
  AddChoice(*parser, "FAMILY", arguments->family, names, fmt::format("{}", fmt::join(names, ", ")))
      ->required();
  parser->add_option("NAME", arguments->member, "one member alone, with its options in full")
      ->type_name("MEMBER");
  AddChoice(*parser, "--format", arguments->format, {"text", "json", "names"},
            "names: one name a line");
  return {parser, [arguments] { return List(*arguments); }};
}

}  // namespace warmjoint
