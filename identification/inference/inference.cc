#include "identification/inference/inference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "identification/inference/apply.h"
#include "identification/inference/bounds.h"
#include "identification/inference/covariance.h"
#include "identification/linear/robust.h"
#include "identification/physical_bounds.h"
#include "identification/uncertainty/tails.h"

namespace warmjoint {
namespace {

/// std and interval of an estimated parameter. deviation: of its coordinate
ParameterInterval Known(const FitParameter& parameter, double deviation, double quantile) {
  const double value = parameter.value;
  // errors of the value itself: an interval that is even to both sides
  if (parameter.coordinate == Coordinate::value) {
    const double reach = quantile * deviation;
    return {value, deviation, {{value - reach, value + reach}}, 0};
  }

  // positive, and its logarithm the nearer to normal
  const bool by_logarithm = parameter.coordinate == Coordinate::logarithm;
  const double relative = by_logarithm ? deviation : deviation / std::abs(value);
  const double factor = std::exp(quantile * relative);
  const std::pair<double, double> ends = std::minmax({value / factor, value * factor});
  return {value, std::abs(value) * relative, {{ends.first, ends.second}}, 0};
}

/// The same about the fit's own value, where it was moved; of one that was set to a bound from that on.
ParameterInterval KnownWithin(FitParameter row, double deviation, double quantile) {
  const double value = row.value;
  row.value -= row.moved;
  ParameterInterval known = Known(row, deviation, quantile);
  known.value = value;
  if (row.role != Role::law || (value != row.lower && value != row.upper)) return known;
  for (double& end : *known.interval95) end = std::clamp(end, row.lower, row.upper);
  return known;
}

/// One for each row of the table; those that were given, or that noise does not tell, have none.
std::vector<ParameterInterval> IntervalsOf(const Fit& fit, const Inference& inference) {
  const Uncertainty& known = inference.known;
  std::vector<ParameterInterval> all;
  Eigen::Index column = 0;
  for (const FitParameter& parameter : fit.parameters) {
    ParameterInterval one{parameter.value, {}, {}, 0};
    if (parameter.estimated) {
      const double quantile = StudentQuantile(known.DegreesOfFreedom(column), kIntervalLevel);
      const double deviation = known.Deviation(column++);
      if (parameter.has_interval) one = KnownWithin(parameter, deviation, quantile);
    }
    all.push_back(one);
  }
  return all;
}

std::string MessageOf(const Fit& fit, const Inference& inference) {
  // without intervals, the reason stands in the place of the noise
  if (DropIntervals(fit.causes)) return fit.summary;
  const std::string loss = fit.loss_bend ? DescribeLoss(fit.residual(), *fit.loss_bend) : "";
  return fit.summary + loss + NoiseOf(inference.known);
}

/// What noise alone says, whatever the bounds.
Inference ByNoise(const Fit& fit) {
  Inference inference;
  if (fit.refusal) {
    inference.status = fit.refusal->status;
    inference.message = fit.refusal->message;
    return inference;
  }

  // how sure the parameters are
  inference.known = CovarianceOf(fit);
  if (!inference.known.covariance.allFinite()) {
    inference.status = Status::bad_data;
    inference.message = "torque or velocity is too large to square";
    return inference;
  }
  inference.parameters = IntervalsOf(fit, inference);
  inference.message = MessageOf(fit, inference);
  inference.gives_friction = true;
  return inference;
}

}  // namespace

bool HasIntervals(const Inference& inference) {
  return std::ranges::any_of(inference.parameters, [](const ParameterInterval& one) {
    return one.interval95.has_value();
  });
}

Inference Infer(const Fit& fit) {
  Inference by_noise = ByNoise(fit);
  std::vector<Cause> causes = fit.causes;
  if (by_noise.status == Status::ok && !IsRefused(causes)) {
    if (auto bound = BeyondBounds(fit, by_noise)) causes.push_back(std::move(*bound));
  }
  return Apply(std::move(by_noise), std::move(causes));
}

Fit AtBounds(Fit fit, const LogSamples& measurements) {
  if (fit.refusal || IsRefused(fit.causes) || !LeavesBounds(fit.parameters)) return fit;
  const Inference by_noise = Apply(ByNoise(fit), fit.causes);
  if (by_noise.status == Status::ok) HoldAtBounds(by_noise, measurements, fit);
  return fit;
}

}  // namespace warmjoint
