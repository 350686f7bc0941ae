#include <fmt/ranges.h>

#include "tools/parser/completion.h"

namespace warmjoint::inline tools {
namespace {

/// What does not depend on the parser.
constexpr const char* kFunctions = R"sh(
_warmjoint_names() { "$program" list "$1" --format names 2>/dev/null; }

_warmjoint_words() { COMPREPLY+=($(compgen -W "$1" -- "$cur")); }

_warmjoint_files() {
  compopt -o filenames 2>/dev/null
  COMPREPLY+=($(compgen "$1" -- "$cur"))
}

# completes a value of the kind $1; $key stands before its '='
_warmjoint_value() {
  local newline=$'\n'
  case $1 in
    *'|'*) _warmjoint_words "${1//|/$newline}" ;;
    FILE|SCENARIO|RECORDING|ESTIMATE|SOURCE|JOINT=FILE|SHARE/FILE) _warmjoint_files -f ;;
    DIR|RUN) _warmjoint_files -d ;;
    SUITE) _warmjoint_words "$(_warmjoint_names suites)"; _warmjoint_files -f ;;
    ROBOT|MODEL) _warmjoint_words "$(_warmjoint_names robots)"; _warmjoint_files -f ;;
    IDENTIFIER) _warmjoint_words "$(_warmjoint_names identifiers)" ;;
    MEMBER) _warmjoint_words "$(_warmjoint_names "$first")" ;;
    KEY=VALUE) [[ $key == law ]] && _warmjoint_words "$(_warmjoint_names laws)" ;;
    COMMAND) _warmjoint_words "$_warmjoint_commands" ;;
  esac
}
)sh";

constexpr const char* kMain = R"sh(
_warmjoint() {
  local IFS=$'\n' program=${COMP_WORDS[0]} cur=${COMP_WORDS[COMP_CWORD]}
  local command= option= key= first= kind= options= number=0 i=1 at=$COMP_CWORD
  COMPREPLY=()

  # bash parts words at '=': what stands behind one belongs to what stands before it
  [[ $cur == = ]] && cur= && at=$((at + 1))
  if [[ $at -gt 2 && ${COMP_WORDS[at - 1]} == = ]]; then
    key=${COMP_WORDS[at - 2]}
    option=${COMP_WORDS[at - 3]}
    [[ $key == -* ]] && option=$key
  else
    option=${COMP_WORDS[at - 1]}
  fi

  # the subcommand, and how many arguments stand before the cursor
  for ((; i < at; i++)); do
    case ${COMP_WORDS[i]} in
      =) ((i++)) ;;
      -*) _warmjoint_option "$command" "${COMP_WORDS[i]}"
          [[ -n $kind && ${COMP_WORDS[i + 1]} != = ]] && ((i++)) ;;
      *) if [[ -z $command ]]; then command=${COMP_WORDS[i]}
         else ((number++)); [[ $number == 1 ]] && first=${COMP_WORDS[i]}
         fi ;;
    esac
  done

  _warmjoint_option "$command" "$option"
  if [[ $option == -* && -n $kind ]]; then
    _warmjoint_value "$kind"
  elif [[ $cur == -* ]]; then
    _warmjoint_words "$options"
  elif [[ -z $command ]]; then
    _warmjoint_words "$_warmjoint_commands"
  else
    _warmjoint_argument "$command" "$number"
    _warmjoint_value "$kind"
  fi
}

complete -F _warmjoint warmjoint
)sh";

std::string Quoted(const std::string& text) { return "'" + text + "'"; }

/// What the script knows a value by: its choices, "text|json", or its kind.
std::string KindOf(const OptionNode& option) {
  const std::vector<std::string> choices = option.Choices();
  return Quoted(choices.empty() ? option.Kind() : fmt::format("{}", fmt::join(choices, "|")));
}

/// "  run) options=...; case $2 in -o|--output) kind=DIR ;; esac ;;"
std::string OptionCase(const CommandNode& command, const std::string& pattern) {
  // all names of its options, and of those that take a value which kind
  std::string names, kinds;
  for (const OptionNode& option : command.options) {
    for (const std::string& name : option.names) names += (names.empty() ? "" : "\\n") + name;
    if (!option.takes_value()) continue;
    kinds += fmt::format("      {}) kind={} ;;\n", fmt::join(option.names, "|"), KindOf(option));
  }

  // names of options are what a dash may become
  std::string text = fmt::format("    {})\n      options=$'{}'\n", pattern, names);
  if (!kinds.empty()) text += fmt::format("      case $2 in\n{}      esac\n", kinds);
  return text + "      ;;\n";
}

/// The kinds of a command's arguments by their number, from 0.
std::string ArgumentCase(const CommandNode& command) {
  // a command without arguments needs no case
  if (command.arguments.empty()) return "";
  std::string text = fmt::format("    {})\n      case $2 in\n", command.name);
  for (std::size_t i = 0; i < command.arguments.size(); ++i) {
    // by their numbers; a repeatable one stands for all that follow
    const OptionNode& argument = command.arguments[i];
    text += fmt::format("      {}) kind={} ;;\n", argument.repeatable ? "*" : std::to_string(i),
                        KindOf(argument));
  }
  return text + "      esac\n      ;;\n";
}

}  // namespace

std::string BashCompletion(const CommandNode& program) {
  // a case of the options and of the arguments for each subcommand
  std::string commands, options = OptionCase(program, "''"), arguments;
  for (const CommandNode& command : program.commands) {
    commands += (commands.empty() ? "" : "\\n") + command.name;
    options += OptionCase(command, command.name);
    arguments += ArgumentCase(command);
  }

  // the words of this parser between functions that are the same for any
  std::string text = "# completion of warmjoint for bash, made by: warmjoint completion bash\n";
  text += fmt::format("_warmjoint_commands=$'{}'\n", commands);
  text += kFunctions;
  text += "\n# options of the subcommand $1, and the kind of value that its option $2 takes\n";
  text += "_warmjoint_option() {\n  kind=\n  case $1 in\n" + options + "  esac\n}\n";
  text += "\n# the kind of argument number $2 of the subcommand $1\n";
  text += "_warmjoint_argument() {\n  kind=\n  case $1 in\n" + arguments + "  esac\n}\n";
  return text + kMain;
}

}  // namespace warmjoint::inline tools
