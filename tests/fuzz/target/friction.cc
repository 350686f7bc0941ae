// Friction as JSON, as it is written again, and as it is stepped.
#include <warmjoint/friction.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "models/foundation/node.h"
#include "models/friction/friction_json.h"
#include "models/friction/joint_friction.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace warmjoint;

Friction Parsed(const std::string& text) { return FrictionFrom(ParseJsonNode(text, "fuzz.json")); }

}  // namespace

void warmjoint::fuzz::Read(std::string_view bytes) {
  const Friction friction = Parsed(std::string(bytes));
  const std::string written = FrictionToTree(friction).dump();
  fuzz::Require(FrictionToTree(Parsed(written)).dump() == written);

  // there and back over some turns
  JointFriction joint(friction);
  joint.SetTimestep(0.01);
  FrictionState state;
  for (int i = 0; i < 20; ++i) {
    const double velocity = 3 * std::sin(0.7 * i);
    const FrictionStep step = joint.Step(state, {0.5 * i, velocity, 1, 10, 0});
    fuzz::Require(!(step.loss < 0));
    state = step.next;
  }
}
