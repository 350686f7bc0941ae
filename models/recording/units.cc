#include "models/recording/units.h"

#include <algorithm>
#include <numbers>

#include "models/foundation/excerpt.h"
#include "models/foundation/nearest_name.h"

namespace warmjoint {

const std::vector<Unit>& Units() {
  constexpr double turn = 2 * std::numbers::pi;  // rad
  static const std::vector<Unit> units{
      // time
      {"s", "s"},
      {"ms", "s", 1e-3},
      {"us", "s", 1e-6},
      {"ns", "s", 1e-9},
      {"min", "s", 60},
      // angle and length
      {"rad", "rad"},
      {"mrad", "rad", 1e-3},
      {"deg", "rad", turn / 360},
      {"turn", "rad", turn},
      {"m", "m"},
      {"cm", "m", 1e-2},
      {"mm", "m", 1e-3},
      {"um", "m", 1e-6},
      // speed
      {"rad/s", "rad/s"},
      {"deg/s", "rad/s", turn / 360},
      {"turn/s", "rad/s", turn},
      {"rpm", "rad/s", turn / 60},
      {"m/s", "m/s"},
      {"mm/s", "m/s", 1e-3},
      {"m/min", "m/s", 1.0 / 60},
      // torque and force
      {"N.m", "N.m"},
      {"Nm", "N.m"},
      {"mN.m", "N.m", 1e-3},
      {"mNm", "N.m", 1e-3},
      {"kN.m", "N.m", 1e3},
      {"N", "N"},
      {"mN", "N", 1e-3},
      {"kN", "N", 1e3},
      // what stands for torque where no torque is logged
      {"A", "A"},
      {"mA", "A", 1e-3},
      {"V", "V"},
      {"mV", "V", 1e-3},
      {"%", "%"},
      {"raw", "raw"},
      // temperature
      {"degC", "degC"},
      {"K", "degC", 1, -273.15},
  };
  return units;
}

const Unit& FindUnit(std::string_view name, const std::vector<std::string>& bases,
                     std::string_view column, const Place& place) {
  // units of the column's own quantity alone
  std::vector<std::string> fitting;
  for (const Unit& unit : Units()) {
    if (std::find(bases.begin(), bases.end(), unit.base) == bases.end()) continue;
    if (unit.name == name) return unit;
    fitting.emplace_back(unit.name);
  }
  Refuse(place, "{} cannot be in '{}'{}", column, Excerpt(name), Suggestion(name, fitting));
}

}  // namespace warmjoint
