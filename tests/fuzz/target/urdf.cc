// Robots as URDF.
#include "models/robots/robot_folder.h"
#include "tests/fuzz/fuzz.h"

void warmjoint::fuzz::Read(std::string_view bytes) {
  const fuzz::ScratchFile file(bytes);
  const auto robot = ReadUrdf(file.path());
  fuzz::Require(robot && robot->getRoot());
  // every joint hangs in the tree
  for (const auto& [name, joint] : robot->joints_) {
    fuzz::Require(joint && robot->getLink(joint->child_link_name) != nullptr);
  }
}
