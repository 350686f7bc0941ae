// What `list` shows: the families of which a user can name members.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace warmjoint {

/// A family. Each member is an object with `name`; its text is made from that object alone.
struct Family {
  std::string name;
  nlohmann::ordered_json (*members)();
  std::vector<std::string> (*names)();  // the same names, without reading more than they need
  std::string (*line)(const nlohmann::ordered_json& member);  // in the list of all
  std::string (*page)(const nlohmann::ordered_json& member);  // by itself
};

/// laws, identifiers, robots, suites.
const std::vector<Family>& Families();

}  // namespace warmjoint
