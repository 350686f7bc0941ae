// Patterns of --map that name a column of each joint of a robot.
#pragma once

#include <string>
#include <vector>

namespace warmjoint {

/// `pattern` for joint j of several: {j} is its place from 0, {name} its name, {1..6} or {0..5} a number for each joint in order,
/// {a|b|c} a text for each. Throws BadInput for other braces, and for lists and numbers that are not one for each joint.
std::string ColumnOfJoint(const std::string& pattern, const std::vector<std::string>& joints,
                          std::size_t j);

}  // namespace warmjoint
