// What to try where a fitted friction pushes the joint.
#pragma once

#include <string>
#include <string_view>

namespace warmjoint::inline identification {

/// A remedy that the fit does not hold already: another law, else gravity, else the torque's sign.
/// identifier: one that can do both; law: of the fit; gravity: its option, none, sincos or paired.
std::string AgainstPushing(std::string_view identifier, std::string_view law,
                           std::string_view gravity);

}  // namespace warmjoint::inline identification
