#include "scenarios/suite.h"

#include "scenarios/read_scenario.h"

namespace warmjoint {

Scenario VariantScenario(const Suite& suite, int variant) {
  if (!suite.ladder) return suite.scenario;
  const Variant& rung = suite.ladder->variants.at(static_cast<size_t>(variant));
  return WithSettings(suite.scenario, rung.settings);
}

}  // namespace warmjoint
