// warmjoint completion bash|zsh, warmjoint man, warmjoint help: what is made from the parser's tree.
#include <fmt/format.h>

#include <memory>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "tools/cli/command.h"
#include "tools/parser/choice.h"
#include "tools/parser/completion.h"
#include "tools/parser/help.h"
#include "tools/parser/man_page.h"
#include "tools/terminal/page.h"

namespace warmjoint::inline tools {
namespace {

namespace fs = std::filesystem;

const std::string kVersion = "warmjoint " WARMJOINT_VERSION;

/// The command of that name in the tree, which may be the program itself.
const CommandNode& FindCommand(const CommandNode& program, const std::string& name) {
  // an empty name stands for the program
  std::vector<std::string> names;
  for (const CommandNode& command : program.commands) {
    if (command.name == name) return command;
    names.push_back(command.name);
  }
  if (!name.empty()) CheckChoice("COMMAND", name, names);
  return program;
}

/// The name of the program before that of a command; nothing before its own.
std::string Before(const CommandNode& program, const CommandNode& command) {
  return &program == &command ? "" : program.name;
}

ExitStatus Complete(const CommandNode& program, const std::string& shell,
                    const std::string& output) {
  const std::string script = shell == "bash" ? BashCompletion(program) : ZshCompletion(program);
  WriteWholeFile(output, script);
  return ExitStatus::done;
}

/// Every page into a folder, which is made where it is absent.
void WritePages(const CommandNode& program, const fs::path& folder) {
  fs::create_directories(folder);
  // the program's own page, then one for each subcommand
  WriteWholeFile(folder / (program.name + ".1"), ManPage(program, "", kVersion));
  for (const CommandNode& command : program.commands) {
    const std::string name = ManName(command, program.name);
    WriteWholeFile(folder / (name + ".1"), ManPage(command, program.name, kVersion));
  }
}

ExitStatus Man(const CommandNode& program, const std::string& name, const std::string& folder) {
  const CommandNode& command = FindCommand(program, name);
  // one page to read, or all pages to install
  if (folder.empty()) {
    fmt::print("{}", ManPage(command, Before(program, command), kVersion));
    return ExitStatus::done;
  }
  if (!name.empty()) {
    Refuse({"warmjoint man"}, "--output takes all pages; leave out COMMAND '{}'", name);
  }
  WritePages(program, folder);
  return ExitStatus::done;
}

ExitStatus Help(const CommandNode& program, const std::string& name) {
  const CommandNode& command = FindCommand(program, name);
  fmt::print("{}", HelpText(command, Before(program, command), PageOf(stdout).width));
  return ExitStatus::done;
}

}  // namespace

Command AddCompletionCommand(CLI::App& program) {
  auto shell = std::make_shared<std::string>();
  auto output = std::make_shared<std::string>("-");
  // - writes to standard output
  CLI::App* parser =
      program.add_subcommand("completion", "Completion of this command line for a shell");
  parser->footer(
      "For this shell:  source <(warmjoint completion bash)\n"
      "For all of yours, in bash:\n"
      "  warmjoint completion bash -o ~/.local/share/bash-completion/completions/warmjoint\n"
      "In zsh, a folder of fpath:  warmjoint completion zsh -o FOLDER/_warmjoint");
  AddChoice(*parser, "SHELL", *shell, {"bash", "zsh"}, "shell that reads it")->required();
  parser->add_option("-o,--output", *output, "file for the script; -: standard output")
      ->type_name("FILE")
      ->capture_default_str();
  return {parser, [=, &program] { return Complete(ReadTree(program), *shell, *output); }};
}

Command AddManCommand(CLI::App& program) {
  // without a name the program's own page
  auto name = std::make_shared<std::string>();
  auto folder = std::make_shared<std::string>();
  CLI::App* parser = program.add_subcommand("man", "Manual page of a command, for man(1)");
  parser->footer("To read one:  warmjoint man run | man -l -");
  parser->add_option("COMMAND", *name, "whose page; default: of the program")->type_name("COMMAND");
  parser->add_option("-o,--output", *folder, "write all pages into this folder")->type_name("DIR");
  return {parser, [=, &program] { return Man(ReadTree(program), *name, *folder); }};
}

Command AddHelpCommand(CLI::App& program) {
  auto name = std::make_shared<std::string>();
  CLI::App* parser = program.add_subcommand("help", "Help on a command, as its --help prints it");
  parser->add_option("COMMAND", *name, "which; default: the program")->type_name("COMMAND");
  return {parser, [=, &program] { return Help(ReadTree(program), *name); }};
}

}  // namespace warmjoint::inline tools
