// How well a model agrees with samples.
#pragma once

#include <Eigen/Core>

#include "models/foundation/field.h"

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

  template <class A>
  void Serialize(A* a) {
    a->Field("n", &n, {.needed = kGiveNumber});
    a->Field("parameters", &parameters, {.needed = kGiveNumber});
    a->Field("effective_parameters", &effective_parameters, {.needed = kGiveNumber});
    a->Field("rmse", &rmse, {.unit = "N.m", .needed = kGiveNumber});
    a->Field("mae", &mae, {.unit = "N.m", .needed = kGiveNumber});
    a->Field("fit", &fit, {.unit = "%", .needed = kGiveNumber});
    a->Field("fpe", &fpe, {.unit = "(N.m)^2", .needed = kGiveNumber});
  }
};

/// Metrics of a fit. measured, fitted: [n] N.m or N.
Metrics ComputeMetrics(const Eigen::VectorXd& measured, const Eigen::VectorXd& fitted,
                       int parameters, double effective_parameters);

}  // namespace warmjoint::inline identification
