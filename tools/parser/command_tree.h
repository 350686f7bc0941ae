// The command line as data: what help, man pages and completion are made from.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace warmjoint::inline tools {

/// An option or an argument without a name of its own.
struct OptionNode {
  std::vector<std::string> names;  // "-o", "--output"; empty for an argument
  std::string value;               // what stands behind it: "FILE", "text|json"; empty for a flag
  std::string argument;            // name of an argument: "RECORDING"
  std::string description;         // words, on one line
  std::string initial;             // value where it is not given; empty: none
  std::string group;               // heading of its own in help; empty: none
  bool required = false;
  bool repeatable = false;  // may be given several times, or takes several values

  bool takes_value() const { return !value.empty(); }
  /// The words of a value that is one of some: "text", "json". Empty for other values. What is in capitals stands for
  /// a text of one's own and is no such word: "cold" of "cold|settled:SPEED".
  std::vector<std::string> Choices() const;
  /// What completes a value without choices: "FILE", "NAME" of "NAME|N".
  std::string Kind() const;
};

/// The program, or a subcommand of it.
struct CommandNode {
  std::string name;  // "warmjoint", "run"
  std::string description;
  std::string footer;  // what its help and its page say at the end
  std::vector<OptionNode> arguments;
  std::vector<OptionNode> options;
  std::vector<CommandNode> commands;
};

/// Walks over the parser and its subcommands, in the order in which they were added.
CommandNode ReadTree(const CLI::App& parser);

/// "warmjoint run SUITE -o DIR [OPTIONS]", "warmjoint COMMAND [OPTIONS]". program: name of the program, which stands
/// before the name of a subcommand; empty for the program itself.
std::string UsageOf(const CommandNode& command, const std::string& program);

}  // namespace warmjoint::inline tools
