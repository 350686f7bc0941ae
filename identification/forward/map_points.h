// Where a joint was at each sample, as maps read it.
#pragma once

#include <warmjoint/friction.h>
#include <warmjoint/prepared_log.h>

#include <Eigen/Core>

namespace warmjoint {

/// One row for each sample, one column for each MapQuantity in its order: [N x 5]; rad or m, rad,
/// rad/s or m/s, N.m or N, N.m or N.
using MapPoints = Eigen::Matrix<double, Eigen::Dynamic, 5, Eigen::RowMajor>;

/// The motor position is the logged one, else gear times the joint's; a load that is not logged is
/// 0. energy: [N] E, N.m or N; empty: 0.
MapPoints PointsOf(const LogSamples& measurements, const Eigen::VectorXd& energy = {});

/// One row of it. row: of `points`.
MapPoint<double> PointAt(const MapPoints& points, Eigen::Index row);

}  // namespace warmjoint
