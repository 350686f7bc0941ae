#include "tools/cli/refuse_arguments.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/nearest_name.h"
#include "tools/parser/help.h"

namespace warmjoint::inline tools {
namespace {

std::vector<std::string> OptionNames(const CommandNode& command) {
  std::vector<std::string> names;
  for (const OptionNode& option : command.options) {
    names.insert(names.end(), option.names.begin(), option.names.end());
  }
  return names;
}

std::vector<std::string> NamesOf(const std::vector<CommandNode>& commands) {
  std::vector<std::string> names;
  for (const CommandNode& command : commands) names.push_back(command.name);
  return names;
}

bool Holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Names of the subcommands that have an option.
std::vector<std::string> CommandsWith(const CommandNode& program, const std::string& option) {
  std::vector<std::string> names;
  for (const CommandNode& command : program.commands) {
    if (Holds(OptionNames(command), option)) names.push_back(command.name);
  }
  return names;
}

/// Refuses an option that the command lacks.
[[noreturn]] void RefuseOption(const CommandNode& program, const CommandNode* command,
                               const Place& place, const std::string& option) {
  // an option before its command
  const std::vector<std::string> others = CommandsWith(program, option);
  if (!command && !others.empty()) {
    Refuse(place, "{} stands behind its command: warmjoint {} {}", option,
           others.size() == 1 ? others.front() : "COMMAND", option);
  }
  // an option that the command has, in the wrong place
  if (command && Holds(OptionNames(*command), option)) {
    Refuse({program.name}, "{0} stands behind its command: warmjoint {1} {0}", option,
           command->name);
  }
  // an option of other commands, or of none
  if (command && !others.empty()) {
    Refuse(place, "there is no option '{}' here; it belongs to: {}", option,
           fmt::join(others, ", "));
  }
  Refuse(place, "there is no option '{}'{}", Excerpt(option),
         Suggestion(option, OptionNames(command ? *command : program)));
}

/// Refuses arguments that nothing took, which explain a failure better than what is then missing.
void RefuseLeftovers(const CLI::App& parser, const CommandNode& program, const CommandNode* command,
                     const Place& place) {
  // the first one that nothing took
  const std::vector<std::string> leftovers = parser.remaining(true);
  if (leftovers.empty()) return;
  const std::string& name = leftovers.front();

  // by its dash an option, else an argument or a subcommand
  if (name.size() > 1 && name[0] == '-') {
    RefuseOption(program, command, place, name.substr(0, name.find('=')));
  }
  if (command) Refuse(place, "does not expect the argument '{}'; see --help", Excerpt(name));
  const std::vector<std::string> names = NamesOf(program.commands);
  Refuse(place, "there is no subcommand '{}'{}", Excerpt(name), Suggestion(name, names));
}

/// The option or argument that a complaint of the parser begins with.
std::optional<OptionNode> Named(const CommandNode& command, const std::string& complaint) {
  // the complaint begins with the name, behind it stands what is wrong
  const std::string name = complaint.substr(0, complaint.find_first_of(": "));
  for (const OptionNode& option : command.options) {
    if (Holds(option.names, name)) return option;
  }
  for (const OptionNode& argument : command.arguments) {
    if (argument.argument == name) return argument;
  }
  return std::nullopt;
}

/// Says what form a value must have that could not be read: "Could not convert: --gear = ten".
void RefuseValue(const CommandNode& command, const Place& place, const CLI::ParseError& error) {
  // the parser's own words, of which name and value are taken
  const std::string complaint = error.what();
  const size_t begin = complaint.find("--"), equals = complaint.find(" = ");
  if (error.get_name() != "ConversionError" || begin > equals || equals == std::string::npos)
    return;
  const std::optional<OptionNode> option = Named(command, complaint.substr(begin));
  if (!option) return;
  Refuse(place, "{} is '{}'; it must be a {}: {}", option->names.back(),
         Excerpt(complaint.substr(equals + 3)), option->value, option->description);
}

/// Says what is missing, where something is.
void RefuseMissing(const CommandNode& command, const Place& place, const CLI::ParseError& error) {
  // what is missing, or stands without its value
  const std::optional<OptionNode> option = Named(command, error.what());
  if (!option) return;
  const std::string& name = option->argument.empty() ? option->names.back() : option->argument;
  if (error.get_name() == "RequiredError") {
    Refuse(place, "{} is required: {}", name, option->description);
  }
  if (error.get_name() == "ArgumentMismatch") {
    Refuse(place, "{} takes {}: {}", name, option->takes_value() ? option->value : "no value",
           option->description);
  }
}

}  // namespace

void RefuseArguments(const CLI::App& program, const CLI::ParseError& error) {
  // without a subcommand there is nothing to compare with
  const CommandNode tree = ReadTree(program);
  const std::vector<CLI::App*> chosen = program.get_subcommands();
  if (chosen.empty()) {
    RefuseLeftovers(program, tree, nullptr, {tree.name});
    Refuse({tree.name}, "give a command, for example check, identify, simulate or run; see --help");
  }

  // what nothing took, what is missing, what cannot be read, and then all else
  const CommandNode command = ReadTree(*chosen.front());
  const Place place{FullName(command, tree.name)};
  RefuseLeftovers(program, tree, &command, place);
  RefuseMissing(command, place, error);
  RefuseValue(command, place, error);
  Refuse(place, "{}; see --help", Excerpt(error.what(), kLongestComplaint));
}

}  // namespace warmjoint::inline tools
