// A scenario carried out by a robot in the engine.
#pragma once

#include <memory>

#include "sim/plant/plant.h"

namespace warmjoint::inline sim {

/// The robot and joint of the scenario in MuJoCo, the other joints held; friction by the plugin.
/// A velocity controller (PI with feedforward of the inertia; gains from the joint's effective
/// inertia and its bandwidth) follows the plan of PlanMotion. Its bandwidth is controller.bandwidth;
/// where that is 0, the one that suffices for inertia, friction, gravity and motion
/// (drive_bandwidth.h), from 20 rad/s to what the step allows, 0.2 / timestep. Recording.following
/// tells whether the joint followed. Measurements.torque is what the drive delivers, M a + gravity + F; Truth holds F, W and E of the engine at the stored
/// samples.
/// A run begins before t = 0: the joint comes up to its first speed with E = E(0), so that the
/// first sample moves. Where the speed changes, the change is over when the next segment begins:
/// with stored samples rarer than the changes are long, W of a sample then holds until the next.
/// Throws BadInput for a robot, joint, step or sampling that cannot be.
std::unique_ptr<Plant> MakeMujocoPlant(const Scenario& scenario);

}  // namespace warmjoint::inline sim
