// The motion of a log in the form that the forward model and maps read.
#pragma once

#include <warmjoint/estimate.h>
#include <warmjoint/friction.h>
#include <warmjoint/friction_model.h>
#include <warmjoint/prepared_log.h>

#include <Eigen/Core>
#include <optional>

#include "identification/gravity.h"

namespace warmjoint {

/// How a law's own bristle is bent at the start of each recording: as in steady sliding, or as the
/// measured torque gives it.
enum class BristleStart { sliding, torque };

/// Time, velocity, positions, load and starts of a log of N samples. The motor position is
/// the logged one, else the log's gear times the joint's.
JointTrajectory TrajectoryOf(const LogSamples& log, BristleStart bristle = BristleStart::sliding);

/// The parts of a model that determine which motion its torque follows.
struct FollowedBy {
  const GravityModel* load = nullptr;  // gravity with which its friction grows; nullptr: with none
  std::optional<double> delay{};       // s, by which the torque is late
};

/// The motion that a model's torque follows, where that is not the log's own: the earlier motion, where the torque is late
/// relative to motion of any kind (Delayed), and under the load that its gravity gives, where friction grows with the load and
/// the log holds none. asked: samples that are to be compared.
std::optional<LogView> Followed(const LogSamples& logged, const Selection& asked,
                                const FollowedBy& model);

/// The friction that a log's motion gives: AlongMotion over TrajectoryOf.
Prediction PredictFriction(const Friction& friction, const LogSamples& log,
                           const ThermalStart& start = {},
                           BristleStart bristle = BristleStart::sliding);

/// One row for each sample, one column for each MapQuantity in its order: [N x 5]; rad or m, rad,
/// rad/s or m/s, N.m or N, N.m or N.
using MapPoints = Eigen::Matrix<double, Eigen::Dynamic, 5, Eigen::RowMajor>;

/// The motor position is the logged one, else gear times the joint's; a load that is not logged is
/// 0. energy: [N] E, N.m or N; empty: 0.
MapPoints PointsOf(const LogSamples& measurements, const Eigen::VectorXd& energy = {});

/// One row of it. row: of `points`.
MapPoint<double> PointAt(const MapPoints& points, Eigen::Index row);

}  // namespace warmjoint
