#include <fmt/ranges.h>

#include "tools/parser/completion.h"

namespace warmjoint::inline tools {
namespace {

/// What does not depend on the parser.
constexpr const char* kFunctions = R"sh(
_warmjoint_names() {
  local -a names
  names=(${(f)"$($program list $1 --format names 2>/dev/null)"})
  compadd -a names
}

# completes a value of the kind $1
_warmjoint_value() {
  case $1 in
    FILE|SCENARIO|RECORDING|ESTIMATE|SOURCE|SHARE/FILE) _files ;;
    DIR|RUN) _files -/ ;;
    JOINT=FILE) compset -P '*=' && _files ;;
    KEY=VALUE) compset -P 'law=' && _warmjoint_names laws ;;
    SUITE) _warmjoint_names suites; _files ;;
    ROBOT|MODEL) _warmjoint_names robots; _files ;;
    IDENTIFIER) _warmjoint_names identifiers ;;
    MEMBER) _warmjoint_names $line[1] ;;
    COMMAND) _warmjoint_commands ;;
  esac
}
)sh";

/// Words inside single quotes, in a place where colons and brackets have a meaning.
std::string Escaped(const std::string& words) {
  std::string text;
  // a quote ends the quoted text, stands escaped, and begins it again
  for (const char c : words) {
    if (c == '\'') {
      text += "'\\''";
      continue;
    }
    // what parts a specification of _arguments is no part of the words
    if (c == ':' || c == '[' || c == ']' || c == '\\') text += '\\';
    text += c;
  }
  return text;
}

/// ":DIR:_warmjoint_value DIR", or ":text|json:(text json)".
std::string ValueSpec(const OptionNode& option) {
  // words are offered as they stand, other kinds by the function that knows them
  const std::vector<std::string> choices = option.Choices();
  if (!choices.empty()) return fmt::format(":value:({})", fmt::join(choices, " "));
  return fmt::format(":{0}:_warmjoint_value {0}", option.Kind());
}

std::string OptionSpec(const OptionNode& option) {
  std::string text;
  // every name of the option, with its words and its value
  for (const std::string& name : option.names) {
    text += fmt::format(" \\\n        '{}{}[{}]{}'", option.repeatable ? "*" : "", name,
                        Escaped(option.description), option.takes_value() ? ValueSpec(option) : "");
  }
  return text;
}

std::string Arguments(const CommandNode& command) {
  // options by name, arguments by their place
  std::string text = "      _arguments";
  for (const OptionNode& option : command.options) text += OptionSpec(option);
  for (std::size_t i = 0; i < command.arguments.size(); ++i) {
    const OptionNode& argument = command.arguments[i];
    text += fmt::format(" \\\n        '{}{}'", argument.repeatable ? "*" : std::to_string(i + 1),
                        ValueSpec(argument));
  }
  return text + "\n";
}

}  // namespace

std::string ZshCompletion(const CommandNode& program) {
  // what does not depend on the command line, then the list of subcommands
  std::string text = "#compdef warmjoint\n# made by: warmjoint completion zsh\n";
  text += kFunctions;
  text += "\n_warmjoint_commands() {\n  local -a commands\n  commands=(\n";
  for (const CommandNode& command : program.commands) {
    text += fmt::format("    '{}:{}'\n", command.name, Escaped(command.description));
  }
  text += "  )\n  _describe command commands\n}\n";

  // what stands behind the subcommand is completed by a case of its own
  text +=
      "\n_warmjoint() {\n  local state program=$words[1]\n  local -a line\n  typeset -A opt_args\n"
      "  _arguments -C '1:command:_warmjoint_commands' '*::argument:->rest'\n"
      "  [[ $state == rest ]] || return\n  case $words[1] in\n";
  for (const CommandNode& command : program.commands) {
    text += fmt::format("    {})\n{}      ;;\n", command.name, Arguments(command));
  }
  // a file of fpath is called at once, another script says what it is for
  return text +
         "  esac\n}\n\nif [[ $zsh_eval_context[-1] == loadautofunc ]]; then\n  _warmjoint \"$@\"\n"
         "else\n  compdef _warmjoint warmjoint\nfi\n";
}

}  // namespace warmjoint::inline tools
