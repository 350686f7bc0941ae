// The command line as a whole: its subcommands, and what is said of words that none takes.

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/names.h"
#include "sim/model/engine_warnings.h"
#include "tools/cli/command.h"
#include "tools/terminal/say.h"

namespace warmjoint {
namespace {

constexpr const char* kHelp =
    "Friction of robot joints that warm up: puts it into MuJoCo, recovers it from logs of "
    "position, velocity and torque, and shows against known truth which identifier to trust.";

constexpr const char* kFooter =
    "`warmjoint COMMAND --help` explains each command.\n\n"
    "Exit status: 0 done, 1 internal error, 2 bad input, 3 identified nothing trustworthy, "
    "4 output could not be written, 5 an identifier answered in no realization of a run, "
    "130 interrupted.";

constexpr const char* kGeneral = "General";  // the group of options that every command has

/// Help as wide as its reader's page: what it is for, how it is called, an example (the footer of a command), the options by group in the
/// order in which they were added, those of every command last.
class Help : public CLI::Formatter {
 public:
  explicit Help(const Page& page) : width_(static_cast<size_t>(page.width)) {
    column_width(std::min<size_t>(30, width_ / 2));
  }

  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    const bool is_command = app->get_parent() != nullptr;
    std::string text = make_description(app) + make_usage(app, std::move(name));
    if (is_command && !app->get_footer().empty()) text += "Example: " + app->get_footer() + "\n";
    text += make_positionals(app) + Groups(app) + make_subcommands(app, mode);
    if (!is_command) text += "\n" + make_footer(app);
    return Wrapped(text, width_);
  }

  std::string make_option(const CLI::Option* option, bool is_positional) const override {
    return Row(make_option_name(option, is_positional) + make_option_opts(option),
               make_option_desc(option));
  }

  std::string make_subcommand(const CLI::App* command) const override {
    return Row(command->get_name(), command->get_description());
  }

 private:
  /// The options by group, those of every command last.
  std::string Groups(const CLI::App* app) const {
    std::vector<std::string> groups = app->get_groups();
    std::ranges::stable_partition(groups, [](const std::string& one) { return one != kGeneral; });
    std::string text;
    for (const std::string& group : groups) {
      const auto options = app->get_options([&group](const CLI::Option* option) {
        return option->get_group() == group && option->nonpositional();
      });
      if (!options.empty()) text += make_group(group, false, options);
    }
    return text;
  }

  /// A name and what it means: beside it where two blanks part them, else below.
  std::string Row(const std::string& name, const std::string& meaning) const {
    const std::string head = "  " + name;
    const bool fits = head.size() + 2 <= get_column_width();
    const std::string blanks(get_column_width() - (fits ? head.size() : 0), ' ');
    return head + (fits ? "" : "\n") + blanks + meaning + "\n";
  }

  size_t width_;
};

/// Commands that stand under one heading of the help.
struct CommandGroup {
  const char* heading;
  std::vector<Command (*)(CLI::App&)> commands;
};

const std::vector<CommandGroup>& CommandGroups() {
  static const std::vector<CommandGroup> groups{
      {"From a log",
       {AddDesignCommand, AddCheckCommand, AddIdentifyCommand, AddIdentifyRobotCommand,
        AddPredictCommand, AddCompensateCommand, AddConvertCommand}},
      {"To a simulator", {AddAttachCommand, AddExportCommand, AddSimulateCommand}},
      {"Pictures and pages", {AddPlotCommand, AddReportCommand}},
      {"Identifiers compared",
       {AddRunCommand, AddCompareCommand, AddStatusCommand, AddMergeCommand, AddValidateCommand}},
      {"What there is", {AddListCommand, AddNewCommand}},
  };
  return groups;
}

/// Adds all subcommands to the program's command line, in the order of its help.
std::vector<Command> AddCommands(CLI::App& program) {
  std::vector<Command> commands;
  for (const CommandGroup& group : CommandGroups()) {
    for (Command (*const add)(CLI::App&) : group.commands) {
      commands.push_back(add(program));
      commands.back().parser->group(group.heading);
    }
  }
  return commands;
}

void AddQuiet(CLI::App& parser) {
  parser
      .add_flag_callback("-q,--quiet", BeQuiet,
                         "no progress and no notices; results, warnings and errors stay")
      ->group(kGeneral);
  parser.get_help_ptr()->group(kGeneral);
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
  program.formatter(std::make_shared<Help>(PageOf(stdout)));
  program.set_help_flag("-h,--help", "this help");
  program.set_version_flag("-V,--version", "warmjoint " + Version(), "the program's version")
      ->group(kGeneral);

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

  // what MuJoCo warns of is a notice as others are
  const EngineWarnings taken([](const std::string& one) { SayNotice("notice: {}\n", one); });

  // exactly one subcommand was given
  const auto chosen = std::find_if(commands.begin(), commands.end(),
                                   [](const Command& command) { return command.parser->parsed(); });
  return chosen->run();
}

}  // namespace warmjoint
