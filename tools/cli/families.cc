#include "tools/cli/families.h"

#include <nlohmann/json.hpp>

#include "models/friction/law.h"
#include "models/robots/robot_folder.h"
#include "tools/cli/suite_names.h"

namespace warmjoint::inline tools {

const std::vector<Family>& Families() {
  static const std::vector<Family> families{
      {"laws", LawsJson, LawNames, LawText, LawText},
      {"identifiers", IdentifiersJson, IdentifierNames, IdentifierLine, IdentifierText},
      {"robots", RobotsJson, RobotNames, RobotText, RobotText},
      {"suites", SuitesJson, SuiteNames, SuiteLine, SuiteText},
  };
  return families;
}

}  // namespace warmjoint::inline tools
