// Scenarios as YAML, and as they are written again.
#include "scenarios/scenario.h"

#include "models/foundation/random_stream.h"
#include "scenarios/read_scenario.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace warmjoint;

Scenario Parsed(std::string_view yaml) { return ParseScenario(std::string(yaml), "fuzz.yaml"); }

}  // namespace

void warmjoint::fuzz::Read(std::string_view bytes) {
  const Scenario scenario = Parsed(bytes);
  const std::string written = ScenarioToYaml(scenario);
  fuzz::Require(ScenarioToYaml(Parsed(written)) == written);

  // a truth by chance, and a plan of a length that is soon made
  Realize(scenario, 0);
  if (FollowsCorners(scenario.motion) || scenario.duration > 1e5) return;
  RandomStream random({scenario.seed, 0}, Stream::motion);
  double time = 0;
  for (const MotionSegment& segment :
       PlanMotion(scenario.motion, scenario.duration, {-1, 1}, random)) {
    time += segment.duration;
  }
  fuzz::Require(std::abs(time - scenario.duration) <= 1e-6 * scenario.duration);
}
