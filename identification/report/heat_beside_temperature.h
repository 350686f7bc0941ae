// The heat that a fit found beside the temperature that its log holds.
#pragma once

#include <vector>

#include "identification/estimate.h"
#include "identification/fit.h"
#include "identification/inference/inference.h"
#include "models/recording/measurements.h"

namespace warmjoint::inline identification {

/// How the column `temperature` goes with E along the log, which the fit has not looked at:
///   T = T0 + b E  by least squares over means of neighbouring samples, each recording with its own T0
/// A row each, in order: `correlation` of both (1), `per_energy` b (K/N.m or K/N), `per_loss` k b (K/W),
/// `lag` (s) and `rmse` (K) of what the line leaves. Where the thermometer lags beyond doubt, E runs
/// through a first-order lag before; else `lag` is 0. Intervals allow for the colour of what is left;
/// a row without one says that too little of the log is independent. This tells that both go together,
/// not which causes which. Empty where the log has no temperature, one of both is constant, or nothing
/// warms; per_loss stands only where the torque is one and there is one stage of warming.
std::vector<EstimatedParameter> HeatBesideTemperature(const Fit& fit, const Inference& inference,
                                                      const FrictionDescription& friction,
                                                      const Measurements& measurements);

/// What a first-order lag of a thermometer makes of a course, which each recording begins at rest.
/// course, time: [N]; lag: s; starts: Measurements::starts.
Eigen::VectorXd Lagged(const Eigen::VectorXd& course, double lag, const Eigen::VectorXd& time,
                       const std::vector<Eigen::Index>& starts);

}  // namespace warmjoint::inline identification
