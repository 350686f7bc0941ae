#include "tools/parser/help.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/terminal/wrap.h"

namespace warmjoint::inline tools {
namespace {

constexpr int kColumn = 26;  // where descriptions begin

/// A head, and its words beside it, or below it where it is long.
std::string Entry(const std::string& head, const std::string& words, int width) {
  std::string text = "  " + head;
  // beside its head where that leaves room, else on lines of its own
  const bool beside = ShownWidth(text) <= kColumn - 2;
  const std::string margin(kColumn, ' ');
  if (!beside) text += "\n";
  bool first = beside;

  // every line begins in the same column
  for (const std::string& line : WrapLine(words, std::max(20, width - kColumn))) {
    if (first) text.append(kColumn - static_cast<std::size_t>(ShownWidth(text)), ' ');
    text += (first ? "" : margin) + line + "\n";
    first = false;
  }
  return text;
}

std::string OptionsUnder(const std::string& heading, const std::vector<OptionNode>& options,
                         const std::string& group, int width) {
  std::string text;
  // the heading stands only where an option follows
  for (const OptionNode& option : options) {
    if (option.group != group) continue;
    if (text.empty()) text = fmt::format("\n{}:\n", heading);
    text += Entry(OptionHead(option), OptionWords(option), width);
  }
  return text;
}

/// Headings of the options' own groups, each once, in their order.
std::vector<std::string> Groups(const CommandNode& command) {
  std::vector<std::string> groups;
  for (const OptionNode& option : command.options) {
    const bool is_new = std::find(groups.begin(), groups.end(), option.group) == groups.end();
    if (!option.group.empty() && is_new) groups.push_back(option.group);
  }
  return groups;
}

}  // namespace

std::string FullName(const CommandNode& command, const std::string& program) {
  return program.empty() ? command.name : program + " " + command.name;
}

std::string OptionHead(const OptionNode& option) {
  if (!option.argument.empty()) return option.argument + (option.repeatable ? "..." : "");
  std::string head;
  for (const std::string& name : option.names) head += (head.empty() ? "" : ", ") + name;
  return option.takes_value() ? head + " " + option.value : head;
}

std::string OptionWords(const OptionNode& option) {
  std::string words = option.description;
  if (option.required && option.argument.empty()) words += "; required";
  if (!option.initial.empty()) words += fmt::format("; default: {}", option.initial);
  if (option.repeatable && option.argument.empty()) words += "; repeatable";
  return words;
}

std::string HelpText(const CommandNode& command, const std::string& program, int width) {
  // what it does, and how it is called
  std::string text = Wrap(command.description, width, 0) + "\n";
  text += Wrap("\nUsage: " + UsageOf(command, program) + "\n", width, 7);

  // what it takes, then the options without a group and those of each group
  text += OptionsUnder("Arguments", command.arguments, "", width);
  if (!command.commands.empty()) text += "\nCommands:\n";
  for (const CommandNode& one : command.commands) text += Entry(one.name, one.description, width);
  text += OptionsUnder("Options", command.options, "", width);
  for (const std::string& group : Groups(command)) {
    text += OptionsUnder(group, command.options, group, width);
  }

  // the last word is the command's own
  if (!command.footer.empty()) text += "\n" + Wrap(command.footer, width, 0) + "\n";
  return text;
}

}  // namespace warmjoint::inline tools
