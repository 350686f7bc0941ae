// What makes a run what it is.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "models/foundation/bad_input.h"

namespace warmjoint::inline tools {

/// Layout of the stored tables; raised whenever they change.
inline constexpr int kSchemaVersion = 2;

/// Two runs with equal descriptions have equal results.
struct RunDescription {
  std::string suite_yaml;  // fully resolved: realizations, seed and identifiers included
  std::vector<std::string> identifiers;  // labels, in the suite's order
  std::vector<std::string> variants;     // names, in the ladder's order; empty without a ladder
  std::vector<std::pair<std::string, std::string>> versions;  // of all that computes, by name
};

/// What differs between two resolved suites, one "path: old in the directory, new asked" each.
std::vector<std::string> SuiteDifferences(const std::string& stored, const std::string& asked);

/// Throws BadInput from `place`, naming what differs, when the two do not give the same results.
void RefuseDifferentRun(const RunDescription& stored, const RunDescription& asked,
                        const Place& place);

}  // namespace warmjoint::inline tools
