#include "tools/cli/program.h"

#include <fmt/format.h>

#include <algorithm>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/nearest_name.h"

namespace warmjoint::inline tools {
namespace {

constexpr const char* kHelp = R"(warmjoint: friction of robot joints that warm up

Puts friction that warms up into MuJoCo, recovers it from position, velocity and torque logs, and
tells against known truth which identifier to trust. `warmjoint SUBCOMMAND --help` explains each.)";

constexpr const char* kFooter = R"(
Exit status: 0 done, 1 internal error, 2 bad input, 3 identified nothing trustworthy,
4 output could not be written, 5 an identifier answered in no realization of a run,
130 interrupted.)";

std::vector<std::string> OptionNames(const CLI::App& parser) {
  std::vector<std::string> names;
  for (const CLI::Option* option : parser.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

std::vector<std::string> SubcommandNames(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* parser : program.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(parser->get_name());
  }
  return names;
}

/// Refuses arguments that nothing took, which explain a failure better than what is then missing.
void RefuseLeftovers(const CLI::App& program) {
  const std::vector<CLI::App*> chosen = program.get_subcommands();
  const CLI::App& parser = chosen.empty() ? program : *chosen.front();
  const std::vector<std::string> leftovers = program.remaining(true);
  if (leftovers.empty()) return;

  const std::string& name = leftovers.front();
  const Place place{"warmjoint" + (chosen.empty() ? "" : " " + parser.get_name())};
  if (name.size() > 1 && name[0] == '-') {
    const std::string option = name.substr(0, name.find('='));
    Refuse(place, "there is no option '{}'{}", Excerpt(option),
           Suggestion(option, OptionNames(parser)));
  }
  if (chosen.empty()) {
    Refuse(place, "there is no subcommand '{}'{}", Excerpt(name),
           Suggestion(name, SubcommandNames(program)));
  }
  Refuse(place, "does not expect the argument '{}'; see --help", Excerpt(name));
}

/// Help and version end the program well; every other parse error is bad input.
ExitStatus AnswerOrRefuse(const CLI::App& program, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) {
    program.exit(error);
    return ExitStatus::done;
  }
  RefuseLeftovers(program);
  const std::vector<CLI::App*> chosen = program.get_subcommands();
  Refuse({"warmjoint" + (chosen.empty() ? "" : " " + chosen.front()->get_name())}, "{}; see --help",
         Excerpt(error.what(), kLongestComplaint));
}

}  // namespace

ExitStatus RunProgram(int argc, const char* const* argv) {
  CLI::App program{kHelp, "warmjoint"};
  program.footer(kFooter);
  program.set_version_flag("--version", "warmjoint " WARMJOINT_VERSION);
  program.require_subcommand(1);
  const std::vector<Command> commands = AddCommands(program);

  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return AnswerOrRefuse(program, error);
  }
  const auto chosen = std::find_if(commands.begin(), commands.end(),
                                   [](const Command& command) { return command.parser->parsed(); });
  return chosen->run();
}

}  // namespace warmjoint::inline tools
