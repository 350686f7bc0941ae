// The command line as a whole: its subcommands, and what is said of words that none takes.

#include <algorithm>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/names.h"
#include "tools/cli/command.h"
#include "tools/terminal/say.h"

namespace warmjoint {
namespace {

constexpr const char* kHelp =
    "Friction of robot joints that warm up: puts it into MuJoCo, recovers it from logs of\n"
    "position, velocity and torque, and shows against known truth which identifier to trust.";

constexpr const char* kFooter =
    "`warmjoint COMMAND --help` explains each command.\n\n"
    "Exit status: 0 done, 1 internal error, 2 bad input, 3 identified nothing trustworthy,\n"
    "4 output could not be written, 5 an identifier answered in no realization of a run,\n"
    "130 interrupted.";

/// Adds all subcommands to the program's command line.
std::vector<Command> AddCommands(CLI::App& program) {
  return {
      AddListCommand(program),    AddNewCommand(program),    AddSimulateCommand(program),
      AddConvertCommand(program), AddCheckCommand(program),  AddIdentifyCommand(program),
      AddPredictCommand(program), AddAttachCommand(program), AddRunCommand(program),
      AddStatusCommand(program),  AddMergeCommand(program),  AddCompareCommand(program),
      AddPlotCommand(program),    AddReportCommand(program), AddIdentifyRobotCommand(program),
      AddExportCommand(program),
  };
}

void AddQuiet(CLI::App& parser) {
  parser.add_flag_callback("-q,--quiet", BeQuiet,
                           "no progress and no notices; results, warnings and errors stay");
}

/// Throws BadInput for arguments that the parser refused.
[[noreturn]] void RefuseArguments(const CLI::App& program, const CLI::ParseError& error) {
  // what stands before the command is the program's own
  const std::vector<CLI::App*> chosen = program.get_subcommands();
  const bool is_own = chosen.empty() || !program.remaining().empty();
  const CLI::App& parser = is_own ? program : *chosen.front();
  const std::string name = is_own ? "warmjoint" : "warmjoint " + parser.get_name();
  const std::vector<std::string> left = parser.remaining();
  if (left.empty()) {
    Refuse({name}, "{}; see {} --help", Excerpt(error.what(), kLongestComplaint), name);
  }

  // an option or a word that nothing took, with the nearest that there is
  const std::string word = left.front().substr(0, left.front().find('='));
  std::vector<std::string> known;
  for (const CLI::Option* option : parser.get_options()) {
    const bool is_long = word.starts_with('-') && !option->get_lnames().empty();
    if (is_long) known.push_back("--" + option->get_lnames().front());
  }
  for (const CLI::App* command : parser.get_subcommands({})) {
    if (!word.starts_with('-')) known.push_back(command->get_name());
  }
  Refuse({name}, "there is no '{}' here{}; see {} --help", Excerpt(word), Suggestion(word, known),
         name);
}

}  // namespace

ExitStatus RunProgram(int argc, const char* const* argv) {
  CLI::App program{kHelp, "warmjoint"};
  program.set_help_flag("-h,--help", "this help");
  program.set_version_flag("-V,--version", "warmjoint " + Version(), "the program's version");

  // all subcommands, each with --quiet
  program.require_subcommand(1);
  const std::vector<Command> commands = AddCommands(program);
  AddQuiet(program);
  for (const Command& command : commands) AddQuiet(*command.parser);
  program.footer(kFooter);  // behind the subcommands, which would take it over

  // names of joints and files go into tables, pages and files of JSON, which hold text
  for (int i = 1; i < argc; ++i) RequireText("the argument", argv[i], {});
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

}  // namespace warmjoint
