// The families of which `list` tells, and their one list.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace warmjoint::inline tools {

/// A family whose members a user can name.
struct Family {
  std::string name;
  nlohmann::ordered_json (*json)();
  std::string (*text)();
};

nlohmann::ordered_json LawsJson();
std::string LawsText();
nlohmann::ordered_json IdentifiersJson();
std::string IdentifiersText();
nlohmann::ordered_json RobotsJson();
std::string RobotsText();
nlohmann::ordered_json SuitesJson();
std::string SuitesText();

/// laws, identifiers, robots, suites.
const std::vector<Family>& Families();

}  // namespace warmjoint::inline tools
