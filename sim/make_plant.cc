#include "models/foundation/bad_input.h"
#include "sim/ideal_plant.h"
#include "sim/mujoco_plant.h"
#include "sim/plant.h"

namespace warmjoint {

std::unique_ptr<Plant> MakePlant(const Scenario& scenario) {
  switch (scenario.plant) {
    case PlantKind::ideal:
      return MakeIdealPlant(scenario);
    case PlantKind::mujoco:
      return MakeMujocoPlant(scenario);
  }
  Refuse({scenario.name}, "there is no such plant");
}

}  // namespace warmjoint
