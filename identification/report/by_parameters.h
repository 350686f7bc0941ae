// How figures that follow from a fitted friction are known, by its parameters.
#pragma once

#include <warmjoint/friction_model.h>

#include <Eigen/Core>
#include <functional>

#include "identification/fit.h"
#include "identification/inference/inference.h"

namespace warmjoint {

/// Some figures of a friction and the start of its log. [q]
using FiguresOf =
    std::function<Eigen::VectorXd(const Friction& friction, const CourseStart& start)>;

/// Their errors.
struct FigureErrors {
  Eigen::MatrixXd covariance;  // [q x q] by noise
  Eigen::VectorXd widened;  // [q] how much farther their intervals reach by what the verdict found
  bool told = true;         // whether every parameter that matters has an interval
};

/// Slopes of the figures over the parameters of law, heat, start and jumps, each in its coordinate, by central
/// differences of a standard deviation; 0 over all others. [q x p]
Eigen::MatrixXd SlopesByDifferences(const Fit& fit, const Inference& inference,
                                    const Friction& friction, const FiguresOf& figures);

/// From the covariance of the parameters, to first order. slopes: [q x p], over the coordinates.
FigureErrors ErrorsBySlopes(const Fit& fit, const Inference& inference,
                            const Eigen::MatrixXd& slopes);

}  // namespace warmjoint
