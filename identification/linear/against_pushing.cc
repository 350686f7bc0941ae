#include "identification/linear/against_pushing.h"

#include <fmt/format.h>

namespace warmjoint::inline identification {

std::string AgainstPushing(std::string_view identifier, std::string_view law,
                           std::string_view gravity) {
  // levels of their own for both directions
  const std::string asymmetric =
      fmt::format("try --identifier {} --set law=asymmetric", identifier);
  if (law != "asymmetric") {
    return gravity == "none" ? asymmetric : fmt::format("{} --gravity {}", asymmetric, gravity);
  }
  if (gravity == "none") {
    return "does the torque hold gravity or another load? " + asymmetric + " --gravity paired";
  }

  // both are fitted already: what is left is the sign
  return "is the sign of the torque reversed (--scale torque=-1)?";
}

}  // namespace warmjoint::inline identification
