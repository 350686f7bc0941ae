#include "models/foundation/bad_input.h"
#include "sim/plant.h"

namespace warmjoint {

std::unique_ptr<Plant> MakePlant(const Scenario& scenario) {
  Refuse({scenario.name}, "no plant yet");
}

}  // namespace warmjoint
