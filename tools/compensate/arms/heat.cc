// Compensators by <warmjoint/compensate.h>: `level`, which follows the level without heat, and `heat`, a friction file with its heat.
#include <warmjoint/friction_model.h>

#include <algorithm>
#include <cmath>

#include "identification/forward/log_trajectory.h"
#include "models/foundation/robust_noise.h"
#include "models/friction/compensator.h"
#include "tools/compensate/arms/arm_list.h"

namespace warmjoint {
namespace {

/// Deviations of a contact that is never seen.
constexpr double kNever = 1e6;

Eigen::VectorXd Run(const CompensatorInput& input, const Friction& friction,
                    const FrictionDoubt& doubt, const CompensatorSettings& settings) {
  Compensator compensator(friction, doubt, settings);
  JointTrajectory motion = TrajectoryOf(input.log);
  motion.torque = input.log.torque;
  return CompensateAlong(compensator, motion).friction;
}

// --- level

struct LevelOptions {
  double begin = 3600;
  double end = 7200;

  template <class A>
  void Serialize(A* a) {
    a->Field("begin", &begin,
             {.unit = "s",
              .bounds = {.at_least = 0},
              .meaning = "of what counts of the day before for slope and first level, s"});
    a->Field("end", &end, {.unit = "s", .bounds = {.above = 0}, .meaning = "of the same, s"});
  }
};

Eigen::VectorXd AlongLevel(const CompensatorInput& input) {
  const auto& options = input.options.Get<LevelOptions>();
  const SpeedLine line = LineOf(input.before, options.begin, options.end);
  Friction friction;
  friction.law = "viscous_coulomb";
  friction.parameters = {{"viscous", line.viscous}, {"coulomb", line.level}};
  return Run(input, friction, {.noise = NoiseOf(input.before)}, {.deviations = kNever});
}

// --- heat

struct HeatOptions {
  double gain = 1;
  double time = 1;
  double doubt = 0.05;
  LevelCorrection correct = LevelCorrection::by_torque;

  template <class A>
  void Serialize(A* a) {
    a->Field("gain", &gain, {.bounds = {.above = 0}, .meaning = "factor on the true thermal gain"});
    a->Field("time", &time,
             {.bounds = {.above = 0}, .meaning = "factor on the true time constant"});
    a->Field("doubt", &doubt,
             {.bounds = {.at_least = 0}, .meaning = "share to which the heat is known"});
    a->Field("correct", &correct, {.meaning = "the level by the measured torque, or not"});
  }
};

Eigen::VectorXd AlongHeat(const CompensatorInput& input) {
  const auto& options = input.options.Get<HeatOptions>();
  Friction friction = input.known;
  FrictionDoubt doubt{.noise = NoiseOf(input.before)};
  if (friction.thermal) {
    friction.thermal->gain *= options.gain;
    friction.thermal->time_constant *= options.time;
    // what the heat is at the speed that the joint had
    const Eigen::VectorXd speed =
        Chosen(input.before.velocity.cwiseAbs(), input.before.velocity.array() != 0);
    if (const auto settled = SettledEnergy(friction, speed.mean())) {
      for (const double stage : *settled) doubt.heat_std += stage;
      doubt.heat_std = options.doubt * std::abs(doubt.heat_std);
    }
  }
  return Run(input, friction, doubt, {.correct = options.correct});
}

}  // namespace

CompensatorArm AdaptingLevel() {
  return {"level", "a level without heat that follows the torque, in a contact, too",
          LevelOptions{}, AlongLevel};
}

CompensatorArm FrictionWithHeat() {
  return {"heat", "a friction file with its heat, corrected by the torque or not", HeatOptions{},
          AlongHeat};
}

}  // namespace warmjoint
