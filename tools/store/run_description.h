// What makes a run what it is.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "models/foundation/bad_input.h"

namespace warmjoint {

/// Two runs with equal descriptions have equal results on one kind of machine.
struct RunDescription {
  std::string suite_yaml;  // fully resolved: realizations, seed and identifiers included
  std::vector<std::pair<std::string, std::string>> versions;  // of all that computes, by name
};

/// Throws BadInput from `place`, naming what differs, when the two do not give the same results.
void RefuseDifferentRun(const RunDescription& stored, const RunDescription& asked,
                        const Place& place);

}  // namespace warmjoint
