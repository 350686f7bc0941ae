// What stands for a torque in a log, by the name of its column: a current, a voltage, a duty cycle, a load.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace warmjoint {

/// A quantity that stands for a torque by its name.
struct StandIn {
  const char* name;   // with its article
  const char* units;  // of --unit, the likeliest first
  std::vector<std::string_view>
      parts;  // of a name's words; of three letters or fewer: a whole word

  /// The likeliest of the units.
  std::string Unit() const {
    const std::string_view all = units;
    return std::string(all.substr(0, all.find_first_of(", ")));
  }
};

/// What a name says that its column is in place of a torque; nullptr where it says nothing of the kind, or speaks of a torque
/// last, as load_torque does, and current_torque.
const StandIn* StandInOf(const std::string& name);

}  // namespace warmjoint
