#include "identification/identifiers/identifier_list.h"

#include <algorithm>
#include <utility>

#include "identification/inference/bounds.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"

namespace warmjoint {

const std::vector<Identifier>& Identifiers() {
  static const std::vector<Identifier> identifiers = [] {
    std::vector<Identifier> all{
        NominalLs(),          PositionRidge(),   MotorRidge(), EnergyMap(), LoadMap(),
        LpvEnergy(),          EnergyAls(),       EnergyMl(),   Rls(),       Kalman(),
        StribeckIdentifier(), LuGreIdentifier(), Auto(),
    };
    // the law of any of them keeps its physical bounds
    for (Identifier& one : all) one.fit = WithinBounds(std::move(one.fit));
    return all;
  }();
  return identifiers;
}

const Identifier* LookUpIdentifier(const std::string& name) {
  const auto called = [&](const Identifier& one) { return one.IsCalled(name); };
  const auto found = std::ranges::find_if(Identifiers(), called);
  return found == Identifiers().end() ? nullptr : &*found;
}

const Identifier& FindIdentifier(const std::string& name) {
  if (const Identifier* found = LookUpIdentifier(name)) return *found;
  std::vector<std::string> known;
  for (const Identifier& identifier : Identifiers()) known.push_back(identifier.name);
  Refuse({}, "there is no identifier '{}'{}", Excerpt(name), Suggestion(name, known));
}

std::string CurrentName(const std::string& name) {
  const Identifier* found = LookUpIdentifier(name);
  return found ? found->name : name;
}

}  // namespace warmjoint
