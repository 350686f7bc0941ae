#include "identification/auto.h"
#include "identification/energy_em.h"
#include "identification/energy_map.h"
#include "identification/energy_ml.h"
#include "identification/identifier.h"
#include "identification/kalman.h"
#include "identification/load_map.h"
#include "identification/lpv_energy.h"
#include "identification/lugre.h"
#include "identification/motor_ridge.h"
#include "identification/nominal_ls.h"
#include "identification/position_ridge.h"
#include "identification/rls.h"
#include "identification/stribeck.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/nearest_name.h"

namespace warmjoint {

const std::vector<Identifier>& Identifiers() {
  static const std::vector<Identifier> identifiers{
      NominalLs(),       PositionRidge(), MotorRidge(), EnergyMap(), LoadMap(),
      LpvEnergy(),       EnergyEm(),      EnergyMl(),   Rls(),       Kalman(),
      StribeckByCeres(), LuGreByCeres(),  Auto(),
  };
  return identifiers;
}

const Identifier& FindIdentifier(const std::string& name) {
  std::vector<std::string> known;
  for (const Identifier& identifier : Identifiers()) {
    if (identifier.name == name) return identifier;
    known.push_back(identifier.name);
  }
  Refuse({}, "there is no identifier '{}'{}", Excerpt(name), Suggestion(name, known));
}

}  // namespace warmjoint
