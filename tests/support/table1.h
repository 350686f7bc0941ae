// The scenario of Table I, the paper's simulation study.
#pragma once

#include "scenarios/scenario.h"

namespace warmjoint::test {

/// kv 5 N.m.s/rad, kc 15 N.m, k -3 N.m/W, tau 600 s; abs(v) ~ U(0.1, 1) rad/s held 20 s, the sign
/// alternating; noise 0.5 N.m; h 1 s; 3600 s; ideal plant.
inline Scenario Table1() {
  Scenario scenario;
  scenario.name = "table1";
  scenario.friction = {"viscous_coulomb", {{"viscous", 5}, {"coulomb", 15}}, Thermal{-3, 600}};
  scenario.motion.speeds.draws = Distribution{Distribution::Kind::uniform, 0.1, 1};
  scenario.motion.hold = 20;
  scenario.noise.torque = 0.5;
  scenario.sampling.rate = 1;
  scenario.duration = 3600;
  scenario.seed = 1;
  return scenario;
}

}  // namespace warmjoint::test
