// How figures that follow from a fitted friction are known, by its parameters.
#pragma once

#include <Eigen/Core>
#include <functional>

#include "identification/fit.h"
#include "identification/inference/inference.h"

namespace warmjoint::inline identification {

/// Some figures of a friction and the start of its log. [q]
using FiguresOf =
    std::function<Eigen::VectorXd(const FrictionDescription& friction, const CourseStart& start)>;

/// Their errors.
struct FigureErrors {
  Eigen::MatrixXd covariance;  // [q x q] by noise
  Eigen::VectorXd widened;  // [q] how much farther their intervals reach by what the verdict found
  bool told = true;         // whether every parameter that matters has an interval
};

/// From the covariance of the parameters of law, heat, start and jumps, by central differences of a standard
/// deviation each.
FigureErrors ErrorsByParameters(const Fit& fit, const Inference& inference,
                                const FrictionDescription& friction, const FiguresOf& figures);

}  // namespace warmjoint::inline identification
