#include "tools/parser/command_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace warmjoint::inline tools {
namespace {

/// The words of a text with one blank between them.
std::string OnOneLine(const std::string& text) {
  std::istringstream words(text);
  std::string line;
  for (std::string word; words >> word;) line += (line.empty() ? "" : " ") + word;
  return line;
}

OptionNode ReadOption(const CLI::Option& option) {
  OptionNode node;
  // short names first, then long ones, as they are typed
  for (const std::string& name : option.get_snames()) node.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) node.names.push_back("--" + name);

  // what stands behind the name, of options that take a value
  if (option.get_items_expected_max() > 0) node.value = option.get_type_name();
  if (option.get_positional()) node.argument = option.get_name(true, false);

  // what help says of it
  node.description = OnOneLine(option.get_description());
  node.initial = option.get_default_str();
  node.group = option.get_group() == "Options" ? "" : option.get_group();
  node.required = option.get_required();
  node.repeatable = option.get_items_expected_max() > 1 ||
                    option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
  return node;
}

}  // namespace

std::vector<std::string> OptionNode::Choices() const {
  std::vector<std::string> choices;
  // other values have no list of words
  if (value.find('|') == std::string::npos) return choices;
  std::istringstream stream(value);
  for (std::string choice; std::getline(stream, choice, '|');) {
    const bool stands_for_another =
        std::any_of(choice.begin(), choice.end(), [](char c) { return 'A' <= c && c <= 'Z'; });
    if (!stands_for_another) choices.push_back(choice);
  }
  return choices;
}

std::string OptionNode::Kind() const { return value.substr(0, value.find('|')); }

CommandNode ReadTree(const CLI::App& parser) {
  CommandNode node{
      parser.get_name(), OnOneLine(parser.get_description()), parser.get_footer(), {}, {}, {}};
  // options with names apart from arguments without
  for (const CLI::Option* option : parser.get_options()) {
    const bool is_argument = option->get_positional();
    (is_argument ? node.arguments : node.options).push_back(ReadOption(*option));
  }

  // subcommands, each a tree of its own
  for (const CLI::App* command : parser.get_subcommands([](const CLI::App*) { return true; })) {
    node.commands.push_back(ReadTree(*command));
  }
  return node;
}

std::string UsageOf(const CommandNode& command, const std::string& program) {
  // a program with subcommands says no more than that
  std::string usage = program.empty() ? command.name : program + " " + command.name;
  if (!command.commands.empty()) return usage + " COMMAND [OPTIONS]";

  // arguments in their order; brackets where one may be left out
  for (const OptionNode& argument : command.arguments) {
    const std::string name = argument.argument + (argument.repeatable ? "..." : "");
    usage += argument.required ? " " + name : fmt::format(" [{}]", name);
  }
  // what must be given stands there, all else is among the options
  for (const OptionNode& option : command.options) {
    if (option.required) usage += fmt::format(" {} {}", option.names.front(), option.value);
  }
  return usage + " [OPTIONS]";
}

}  // namespace warmjoint::inline tools
