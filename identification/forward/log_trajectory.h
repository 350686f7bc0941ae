// The motion of a log as the forward model reads it.
#pragma once

#include <warmjoint/friction_model.h>
#include <warmjoint/prepared_log.h>

namespace warmjoint {

/// How a law's own bristle is bent at the start of each recording: as in steady sliding, or as the
/// measured torque tells.
enum class BristleStart { sliding, torque };

/// Time, velocity, positions, load and starts of a log of N samples. The motor position is
/// the logged one, else the log's gear times the joint's.
JointTrajectory TrajectoryOf(const LogSamples& log, BristleStart bristle = BristleStart::sliding);

/// The friction that a log's motion gives: AlongMotion over TrajectoryOf.
Prediction PredictFriction(const Friction& friction, const LogSamples& log,
                           const ThermalStart& start = {},
                           BristleStart bristle = BristleStart::sliding);

}  // namespace warmjoint
