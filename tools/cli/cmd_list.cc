// warmjoint list laws|identifiers|robots|suites: what there is to choose from.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "tools/cli/command.h"
#include "tools/cli/families.h"

namespace warmjoint::inline tools {
namespace {

struct ListArguments {
  std::string family;
  std::string format = "text";
};

ExitStatus List(const ListArguments& arguments) {
  for (const Family& family : Families()) {
    if (family.name != arguments.family) continue;
    if (arguments.format == "json") {
      fmt::print("{}\n", family.json().dump(2));
    } else {
      fmt::print("{}", family.text());
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
  parser->add_option("FAMILY", arguments->family, fmt::format("{}", fmt::join(names, ", ")))
      ->required()
      ->check(CLI::IsMember(names));
  parser->add_option("--format", arguments->format, "text or json")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  return {parser, [arguments] { return List(*arguments); }};
}

}  // namespace warmjoint::inline tools
