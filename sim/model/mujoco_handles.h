// Owners of MuJoCo's objects.
#pragma once

#include <mujoco/mujoco.h>

#include <memory>

namespace warmjoint::inline sim {

struct DeleteMujoco {
  void operator()(mjSpec* spec) const { mj_deleteSpec(spec); }
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};

using SpecPtr = std::unique_ptr<mjSpec, DeleteMujoco>;
using ModelPtr = std::unique_ptr<mjModel, DeleteMujoco>;
using DataPtr = std::unique_ptr<mjData, DeleteMujoco>;

}  // namespace warmjoint::inline sim
