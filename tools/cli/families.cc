#include "tools/cli/families.h"

#include <nlohmann/json.hpp>

namespace warmjoint::inline tools {

const std::vector<Family>& Families() {
  static const std::vector<Family> families{
      {"laws", LawsJson, LawsText},
      {"identifiers", IdentifiersJson, IdentifiersText},
      {"robots", RobotsJson, RobotsText},
      {"suites", SuitesJson, SuitesText},
  };
  return families;
}

}  // namespace warmjoint::inline tools
