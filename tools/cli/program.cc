#include "tools/cli/program.h"

#include <fmt/format.h>

#include <algorithm>

#include "models/foundation/bad_input.h"
#include "tools/cli/refuse_arguments.h"
#include "tools/parser/exit_statuses.h"
#include "tools/parser/help.h"
#include "tools/terminal/page.h"
#include "tools/terminal/quiet.h"

namespace warmjoint::inline tools {
namespace {

constexpr const char* kHelp =
    "Friction of robot joints that warm up: puts it into MuJoCo, recovers it from logs of "
    "position, "
    "velocity and torque, and tells against known truth which identifier to trust.";

std::string Footer() {
  std::string footer = "`warmjoint COMMAND --help` explains each command.\n\nExit status:";
  // all statuses in one sentence
  const char* separator = " ";
  for (const ExitMeaning& one : ExitMeanings()) {
    footer += fmt::format("{}{} {}", separator, one.status, one.meaning);
    separator = ", ";
  }
  return footer + ".";
}

void AddQuiet(CLI::App& parser) {
  parser.add_flag_callback("-q,--quiet", BeQuiet,
                           "no progress and no notices; results, warnings and errors stay");
}

/// Help of the program or of a subcommand.
std::string HelpOf(const CLI::App* parser) {
  const CLI::App* program = parser->get_parent();
  return HelpText(ReadTree(*parser), program ? program->get_name() : "", PageOf(stdout).width);
}

}  // namespace

ExitStatus RunProgram(int argc, const char* const* argv) {
  // help comes from the tree of the parser, as man pages and completion do
  CLI::App program{kHelp, "warmjoint"};
  program.formatter_fn([](const CLI::App* parser, const std::string&, CLI::AppFormatMode) {
    return HelpOf(parser);
  });
  program.set_help_flag("-h,--help", "this help");
  program.set_version_flag("-V,--version", "warmjoint " WARMJOINT_VERSION, "the program's version");

  // all subcommands, each with --quiet
  program.require_subcommand(1);
  const std::vector<Command> commands = AddCommands(program);
  AddQuiet(program);
  for (const Command& command : commands) AddQuiet(*command.parser);
  program.footer(Footer());  // behind the subcommands, which would take it over

  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // help and version end the program well; every other parse error is bad input
    if (error.get_exit_code() != 0) RefuseArguments(program, error);
    program.exit(error);
    return ExitStatus::done;
  }

  // exactly one subcommand was given
  const auto chosen = std::find_if(commands.begin(), commands.end(),
                                   [](const Command& command) { return command.parser->parsed(); });
  return chosen->run();
}

}  // namespace warmjoint::inline tools
