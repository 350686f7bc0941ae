// Axes that fit their data.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tools/report/draw/figure.h"

namespace warmjoint::report {

/// Lowest and highest finite value of all; (NaN, NaN) where there is none.
std::pair<double, double> RangeOf(const std::vector<Eigen::VectorXd>& values);

/// A linear axis over the values with 4 % to spare at both ends. Data without extent, or none, get
/// one about them.
Axis LinearAxis(std::string label, const std::vector<Eigen::VectorXd>& values);

/// A linear axis that starts at zero, for sizes that are compared by their height.
Axis ZeroAxis(std::string label, const std::vector<Eigen::VectorXd>& values);

/// A logarithmic axis over the positive values, with some to spare.
Axis LogarithmicAxis(std::string label, const std::vector<Eigen::VectorXd>& values);

/// Logarithmic where the values span more than a factor of 30 and none is below 0, else from zero.
Axis MagnitudeAxis(std::string label, const std::vector<Eigen::VectorXd>& values);

/// One turn, 0 ... 2 pi rad, with ticks at its quarters.
Axis AngleAxis(std::string label);

/// An axis that names categories at 0, 1, 2, ...
Axis CategoryAxis(std::string label, const std::vector<std::string>& names);

}  // namespace warmjoint::report
