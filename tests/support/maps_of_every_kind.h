// Maps with every kind of axis, and their rows without any short cut.
#pragma once

#include <Eigen/Core>
#include <numbers>
#include <vector>

#include "identification/forward/map_points.h"
#include "identification/ridge/row_groups.h"
#include "models/foundation/random_stream.h"
#include "models/friction/evaluate_map.h"

namespace warmjoint::test {

/// Maps of every kind of axis and factor: 24 x 4 kernels, 12 x 3 on a circle, 5.
inline std::vector<FrictionMap> MapsOfEveryKind(KernelKind kind) {
  return {{{{MapQuantity::position, EvenAxis(-1, 1, 24)},
            {MapQuantity::velocity, SpeedAxis(0.2, 1, 2)}},
           kind,
           {}},
          {{{MapQuantity::motor_position, CircleAxis(2 * std::numbers::pi, 12)},
            {MapQuantity::energy, EvenAxis(-2, 0, 3)}},
           kind,
           {},
           MapFactor::direction},
          {{{MapQuantity::load, EvenAxis(0, 3, 5)}}, kind, {}, MapFactor::velocity}};
}

/// Points over their ranges and beyond, one at rest, one far away. [n x 5]
inline MapPoints DrawnPoints(Eigen::Index n) {
  RandomStream random({3, 0}, Stream::motion);
  MapPoints points(n, 5);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double p = random.Uniform(-1.2, 1.2);
    points.row(i) << p, 100 * p, random.Uniform(-1, 1), random.Uniform(-2, 0), random.Uniform(0, 3);
  }
  points(0, 2) = 0;    // at rest: kernels on either side of v = 0 have none
  points(1, 0) = 1e3;  // far from every centre
  return points;
}

/// Rows of kernels by EvaluateMap: a weight of 1 on one kernel gives that kernel.
inline Eigen::MatrixXd DenseRows(std::vector<FrictionMap> maps, const MapPoints& points) {
  Eigen::MatrixXd rows(points.rows(), KernelCount(maps));
  Eigen::Index column = 0;
  for (FrictionMap& map : maps) {
    for (size_t k = 0; k < map.size(); ++k, ++column) {
      map.weights.assign(map.size(), 0);
      map.weights[k] = 1;
      for (Eigen::Index i = 0; i < points.rows(); ++i) {
        rows(i, column) = EvaluateMap(map, PointAt(points, i));
      }
    }
  }
  return rows;
}

}  // namespace warmjoint::test
