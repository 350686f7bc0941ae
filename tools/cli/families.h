// The families of which `list` tells, and their one list.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace warmjoint::inline tools {

/// A family whose members a user can name. Each member is an object with `name`; its text is made from that object
/// alone, for a number of columns.
struct Family {
  std::string name;
  nlohmann::ordered_json (*members)();
  std::vector<std::string> (*names)();  // the same names, without reading more than they need
  std::string (*line)(const nlohmann::ordered_json& member, int width);  // in the list of all
  std::string (*page)(const nlohmann::ordered_json& member, int width);  // by itself
};

nlohmann::ordered_json LawsJson();
std::string LawText(const nlohmann::ordered_json& law, int width);

nlohmann::ordered_json IdentifiersJson();
std::vector<std::string> IdentifierNames();
std::string IdentifierLine(const nlohmann::ordered_json& identifier, int width);
std::string IdentifierText(const nlohmann::ordered_json& identifier, int width);

nlohmann::ordered_json RobotsJson();
std::string RobotText(const nlohmann::ordered_json& robot, int width);

nlohmann::ordered_json SuitesJson();
std::string SuiteLine(const nlohmann::ordered_json& suite, int width);
std::string SuiteText(const nlohmann::ordered_json& suite, int width);

/// laws, identifiers, robots, suites.
const std::vector<Family>& Families();

}  // namespace warmjoint::inline tools
