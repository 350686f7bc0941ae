#include "tools/actions/run_arguments.h"

#include <algorithm>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "tools/suite/external_identifier.h"
#include "tools/suite/prepare_identifiers.h"

namespace warmjoint {
namespace {

/// Refuses a command that a suite brings along and nobody has agreed to: a suite from elsewhere would be
/// a program.
void RefuseCommand(const SuiteIdentifier& identifier, const RunArguments& arguments) {
  const auto command = identifier.options.find("command");
  if (identifier.name != kExternal || command == identifier.options.end()) return;
  // commands of a suite run only where the user trusts them
  if (arguments.allow_commands) return;
  Refuse({arguments.suite},
         "identifier {} runs the command '{}'; where you trust it, give --allow-commands",
         Excerpt(identifier.label), Excerpt(command->second, kLongestComplaint));
}

}  // namespace

Suite ResolveSuite(const RunArguments& arguments) {
  Suite suite = ReadSuite(arguments.suite);
  // what the command line says goes over the suite
  if (arguments.realizations) suite.realizations = static_cast<int>(*arguments.realizations);
  if (arguments.seed) suite.scenario.seed = *arguments.seed;
  // commands find their files wherever the run is started from
  for (SuiteIdentifier& identifier : suite.identifiers) {
    identifier = WithFilesOfSuite(std::move(identifier), arguments.suite);
  }
  const std::vector<SuiteIdentifier> own = suite.identifiers;
  suite.identifiers = ChooseIdentifiers(own, arguments.identifiers);
  for (const SuiteIdentifier& identifier : suite.identifiers) {
    // what the command line itself names was agreed to by naming it
    const bool brought = std::find(own.begin(), own.end(), identifier) != own.end();
    if (brought) RefuseCommand(identifier, arguments);
  }
  return suite;
}

}  // namespace warmjoint
