// The log of a real ball screw, EMPS (Janot, Gautier, Brunot 2019): 25 s at 1 kHz, positions and force.
#pragma once

#include "models/recording/read_recording.h"
#include "tests/support/shared_data.h"

namespace warmjoint::test {

inline constexpr const char* kEmpsFile = "data/emps/DATA_EMPS.csv";

inline Measurements EmpsLog() {
  ReadSettings layout;
  layout.map = {{"time", "t_s"}, {"position", "q_m"}, {"torque", "force_N"}};
  layout.joint = JointKind::linear;
  return ReadCsv((SharedFolder() / kEmpsFile).string(), layout);
}

}  // namespace warmjoint::test
