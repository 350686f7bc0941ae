#include "models/foundation/bad_input.h"
#include "sim/ideal_plant.h"
#include "sim/plant.h"

namespace warmjoint {

std::unique_ptr<Plant> MakePlant(const Scenario& scenario) {
  switch (scenario.plant) {
    case PlantKind::ideal:
      return MakeIdealPlant(scenario);
    case PlantKind::mujoco:
      break;
  }
  Refuse({scenario.name}, "the mujoco plant is not part of this build");
}

}  // namespace warmjoint
