// What turns a scenario into a recording, and a recording into a motion.
#pragma once

#include <warmjoint/recording.h>
#include <warmjoint/simulation.h>

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>

#include "scenarios/motion.h"
#include "scenarios/scenario.h"

namespace warmjoint {

/// Is told now and then which share of a run is done, 0 to 1.
using RunWatch = std::function<void(double share)>;

/// A plant carries out scenarios. One object may be used by one thread at a time; make one for
/// each.
class Plant {
 public:
  virtual ~Plant() = default;
  /// One realization: all its random numbers come from (scenario.seed, realization).
  /// Throws BadInput where the scenario asks what the plant cannot do. watch: of runs that take their time.
  virtual Simulation Run(std::uint64_t realization, const RunWatch& watch = {}) = 0;
};

/// The plant that the scenario names, with its model loaded and checked. Throws BadInput.
std::unique_ptr<Plant> MakePlant(const Scenario& scenario);

/// Samples the planned velocity at h = 1 / sampling.rate, lets friction warm as AlongMotion does,
/// E2 from 0, and logs torque = F + white noise, with no inertia, controller or filter.
/// The position is the integral of the planned velocity. Velocity and position get their own noise.
/// Throws BadInput for a motion that travels between the limits of a robot: it has none. Its Run
/// throws BadInput where friction changes its sign and drives the joint (E below -Fn sign(v)).
std::unique_ptr<Plant> MakeIdealPlant(const Scenario& scenario);

/// The robot and joint of the scenario in MuJoCo, the other joints held; friction by the plugin.
/// A velocity controller (PI with feedforward of the inertia; gains from the joint's effective
/// inertia and its bandwidth) follows the plan of PlanMotion. Its bandwidth is controller.bandwidth;
/// where that is 0, the one that suffices for inertia, friction, gravity and motion
/// (velocity_drive.h), from 20 rad/s to what the step allows, 0.2 / timestep. Recording.following
/// tells whether the joint followed. Measurements.torque is what the drive delivers, M a + gravity + F; Truth holds F, W and E of the engine at the stored
/// samples.
/// A run begins before t = 0: the joint comes up to its first speed with E = E(0), so that the
/// first sample moves. Where the speed changes, the change is over when the next segment begins:
/// with stored samples rarer than the changes are long, W of a sample then holds until the next.
/// Throws BadInput for a robot, joint, step or sampling that cannot be.
std::unique_ptr<Plant> MakeMujocoPlant(const Scenario& scenario);

/// Adds to the logged torque what the scenario disturbs it by: a lag, forces that no model holds, outliers, coloured and
/// uneven noise, a periodic torque; makes of the motion what poorer sensors log; and spoils what is left as faulty
/// sensors, clocks and files do; truth loses the samples that the log loses. Random numbers come from streams of their
/// own, so that they leave all others as they are. Coloured noise joins Truth.torque_noise; outliers and uneven noise,
/// being no noise of one size, do not. position: [N] true, rad or m; acceleration: [N] true, rad/s^2 or m/s^2, or empty:
/// as neighbouring samples show it.
void DisturbLog(const Scenario& scenario, std::uint64_t realization, Simulation& recording,
                const Eigen::VectorXd& position, const Eigen::VectorXd& acceleration = {});

/// A velocity by its corners that follows the recording: the segments at constant speed exactly;
/// between them up to eight corners at the recorded mean velocities, moved together so that the way
/// from segment to segment is the recorded one. The start is the first position.
/// Throws BadInput where the recording has no segment at constant speed.
Motion MotionOf(const Measurements& measurements, const Selection& selection);

}  // namespace warmjoint
