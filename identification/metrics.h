// How well a model agrees with samples.
#pragma once

#include <Eigen/Core>

namespace warmjoint::inline identification {

/// Agreement of a fit with the samples that it kept. y: measured, yhat: fitted, e = y - yhat.
struct Metrics {
  int n = 0;                        // samples
  int parameters = 0;               // d
  double effective_parameters = 0;  // trace of the hat matrix; d where nothing is penalised
  double rmse = 0;                  // sqrt(mean(e^2)), N.m or N
  double mae = 0;                   // mean(|e|), N.m or N
  double fit = 0;                   // 100 (1 - |e| / |y - mean(y)|), %
  double fpe = 0;                   // V (1 + d/n)/(1 - d/n), V = mean(e^2)
};

/// Metrics of a fit. measured, fitted: [n] N.m or N.
Metrics ComputeMetrics(const Eigen::VectorXd& measured, const Eigen::VectorXd& fitted,
                       int parameters, double effective_parameters);

}  // namespace warmjoint::inline identification
