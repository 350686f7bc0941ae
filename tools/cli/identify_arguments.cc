#include "tools/cli/identify_arguments.h"

#include "tools/cli/command.h"

namespace warmjoint::inline tools {

IdentifySettings SettingsOf(const IdentifyArguments& arguments, const std::string& identifier) {
  // the settings that all identifiers share, and what is this one's
  IdentifySettings settings = arguments.settings;
  settings.identifier = identifier;
  settings.options = ReadPairs(arguments.set, "--set");
  if (arguments.force) settings.void_numbers = VoidNumbers::show;
  return settings;
}

}  // namespace warmjoint::inline tools
