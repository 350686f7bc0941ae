#include "identification/preparation/select.h"

namespace warmjoint {

Selection SelectMoving(const Measurements& measurements) {
  return {measurements.velocity.array() != 0, {}};
}

}  // namespace warmjoint
