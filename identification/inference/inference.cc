#include "identification/inference/inference.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "identification/fit/fit_data.h"
#include "identification/inference/apply.h"
#include "identification/inference/bounds.h"
#include "identification/linear/huber.h"
#include "identification/model/normal_equations.h"
#include "identification/sentences/fit.h"
#include "identification/uncertainty/tails.h"

namespace warmjoint {
namespace {

/// std and interval of an estimated parameter. deviation: of its coordinate
ParameterInterval Known(const Unknown& parameter, double deviation, double quantile) {
  const double value = parameter.value;
  // where the error is that of the value itself, the interval is symmetric
  if (parameter.coordinate == Coordinate::value) {
    const double reach = quantile * deviation;
    return {value, deviation, {{value - reach, value + reach}}};
  }

  // of a positive value the logarithm is nearer to normal
  const bool by_logarithm = parameter.coordinate == Coordinate::logarithm;
  const double relative = by_logarithm ? deviation : deviation / std::abs(value);
  const double factor = std::exp(quantile * relative);
  const std::pair<double, double> ends = std::minmax({value / factor, value * factor});
  return {value, std::abs(value) * relative, {{ends.first, ends.second}}};
}

/// By how much rows that hold others at their bounds changed a value.
double HeldBy(const std::vector<Cause>& causes, std::size_t row) {
  double held = 0;
  for (const Cause& cause : causes) {
    if (cause.action == Action::hold) held += cause.BiasOf(row);
  }
  return held;
}

/// The same about the value before rows were held; of a value that is at a bound, from the bound on.
ParameterInterval KnownWithin(Unknown row, double moved, double deviation, double quantile) {
  const double held = row.value;
  row.value -= moved;
  ParameterInterval estimated = Known(row, deviation, quantile);
  if (!IsNominal(row.role) || (held != row.lower && held != row.upper)) return estimated;
  for (double& end : *estimated.interval95) end = std::clamp(end, row.lower, row.upper);
  return estimated;
}

/// One for each row of the table. Rows that were given, and rows to whose error the noise sets no bound, have no interval.
std::vector<ParameterInterval> IntervalsOf(const Fit& fit, const Inference& inference) {
  const Uncertainty& uncertainty = inference.uncertainty;
  std::vector<ParameterInterval> all;
  Eigen::Index column = 0;
  for (std::size_t i = 0; i < fit.parameters.size(); ++i) {
    const Unknown& parameter = fit.parameters[i];
    const double moved = HeldBy(fit.causes, i);
    ParameterInterval one{parameter.value - moved, {}, {}};
    if (parameter.estimated) {
      const double quantile = StudentQuantile(uncertainty.DegreesOfFreedom(column), kIntervalLevel);
      const double deviation = uncertainty.Deviation(column++);
      if (parameter.has_interval) {
        one = KnownWithin(parameter, moved, deviation, quantile);
        const Eigen::VectorXd own =
            Eigen::VectorXd::Unit(uncertainty.covariance.rows(), column - 1);
        one.parts = NoiseParts(uncertainty, own, one.HalfWidth());
      }
    }
    all.push_back(one);
  }
  return all;
}

/// What each step adds to a half width. steps: the half width after each, which takes one more property into account
std::vector<WidthPart> PartsOf(std::span<const std::pair<Source, double>> steps, double half) {
  // a step that makes it narrower is subtracted from the parts before it
  std::vector<WidthPart> parts;
  double reached = 0;
  for (const auto& [by, reach] : steps) {
    for (double over = reached - reach; over > 0 && !parts.empty();) {
      const double taken = std::min(over, parts.back().half_width);
      parts.back().half_width -= taken;
      reached -= taken;
      over -= taken;
      if (parts.back().half_width <= 0) parts.pop_back();
    }
    if (reach > reached) parts.push_back({by, reach - reached});
    reached = std::max(reached, reach);
  }
  for (WidthPart& part : parts) part.half_width *= half / reached;
  return parts;
}

Source SourceOf(ErrorBy by) {
  switch (by) {
    case ErrorBy::noise:
      return Source::noise;
    case ErrorBy::description:
      return Source::description;
    case ErrorBy::place:
      return Source::field_over_place;
    case ErrorBy::speed:
      return Source::field_over_speed;
    case ErrorBy::time:
      return Source::field_over_time;
    case ErrorBy::strength:
      break;
  }
  return Source::field_strength;
}

std::string MessageOf(const Fit& fit, const Inference& inference) {
  // without intervals, the reason for that takes the place of the sentence on the noise
  if (DropIntervals(fit.causes)) return fit.summary;
  const std::string loss =
      fit.rows.loss_bend ? DescribeLoss(fit.rows.residual(), *fit.rows.loss_bend) : "";
  return fit.summary + loss + NoiseOf(inference.uncertainty);
}

/// The uncertainty of a fit to whitened rows, where the colour that is left in the rows counts, too. The degrees of freedom are
/// those of noise of the colour that was taken off, since that colour was estimated from the same samples.
Uncertainty OfWhitened(const Fit& fit, const Whitening& whitening) {
  const ErrorModel& errors = fit.rows.errors;
  Uncertainty uncertainty = CovarianceOf(
      {.rows = RowsFrom([&] { return whitening.Of(Kept(fit.rows.jacobian(), fit.rows.used)); }),
       .cofactor = errors.cofactor,
       .residual = whitening.Of(fit.rows.residual()).col(0),
       .selection = fit.rows.used,
       .fitted = fit.rows.fitted,
       .prior = errors.prior});
  uncertainty.noise = whitening.noise();
  // the covariance if noise of the same variance were white
  const Eigen::MatrixXd plain = Kept(fit.rows.jacobian(), fit.rows.used);
  uncertainty.white = uncertainty.noise.variance * Cofactor(GramOf(plain));
  const auto samples = static_cast<double>(whitening.size());
  const auto count = static_cast<double>(fit.rows.errors.cofactor.rows());
  uncertainty.degrees_of_freedom =
      std::min(uncertainty.degrees_of_freedom,
               std::max(samples / uncertainty.noise.variance_inflation - count, 1.0));
  return uncertainty;
}

}  // namespace

bool HasIntervals(const Inference& inference) {
  return std::ranges::any_of(inference.parameters, [](const ParameterInterval& one) {
    return one.interval95.has_value();
  });
}

Inference ByNoise(const Fit& fit) {
  Inference inference;
  if (fit.refusal) {
    inference.status = fit.refusal->status;
    inference.message = fit.refusal->message;
    return inference;
  }

  // the uncertainty of the parameters
  inference.uncertainty = CovarianceOf(fit);
  if (!inference.uncertainty.covariance.allFinite()) {
    inference.status = Status::bad_data;
    inference.message = kTooLargeToSquare;
    return inference;
  }
  inference.parameters = IntervalsOf(fit, inference);
  inference.message = MessageOf(fit, inference);
  inference.gives_friction = true;
  return inference;
}

std::vector<Cause> OwnCauses(const Fit& fit, const Inference& by_noise) {
  std::vector<Cause> causes = fit.causes;
  if (by_noise.status == Status::ok && !IsRefused(causes)) {
    if (auto bound = BeyondBounds(fit, by_noise)) causes.push_back(std::move(*bound));
  }
  return causes;
}

Inference Infer(const Fit& fit) {
  const Inference by_noise = ByNoise(fit);
  return Apply(by_noise, OwnCauses(fit, by_noise));
}

Uncertainty CovarianceOf(const Fit& fit) {
  const ErrorModel& errors = fit.rows.errors;
  // a fit whose table lacks some of the fitted parameters has a function of its own
  if (errors.covariance) return errors.covariance();

  // rows that were whitened are judged by the colour that is left
  if (errors.whitening) return OfWhitened(fit, *errors.whitening);

  // a robust loss or a lag brings scores in place of the residual
  return CovarianceOf({.rows = RowsFrom([&] { return Kept(fit.rows.jacobian(), fit.rows.used); }),
                       .cofactor = errors.cofactor,
                       .residual = errors.scores.size() > 0 ? errors.scores : fit.rows.residual(),
                       .selection = fit.rows.used,
                       .fitted = fit.rows.fitted,
                       .weights = errors.weights,
                       .prior = errors.prior});
}

std::vector<WidthPart> FieldParts(const std::vector<ErrorUpTo<double>>& up_to, double half) {
  std::vector<std::pair<Source, double>> steps;
  for (const ErrorUpTo<double>& one : up_to) steps.emplace_back(SourceOf(one.by), one.value);
  return PartsOf(steps, half);
}

std::vector<WidthPart> NoiseParts(const Uncertainty& uncertainty, const Eigen::VectorXd& slopes,
                                  double half) {
  const auto deviation = [&](const Eigen::MatrixXd& covariance) {
    return std::sqrt(std::max(slopes.dot(covariance * slopes), 0.0));
  };
  const double all = deviation(uncertainty.covariance);
  if (!uncertainty.up_to.empty() && all > 0) {
    std::vector<ErrorUpTo<double>> up_to;
    for (const auto& [by, covariance] : uncertainty.up_to) {
      up_to.push_back({by, deviation(covariance)});
    }
    return FieldParts(up_to, half);
  }
  const bool is_told = uncertainty.white.rows() == slopes.size() && uncertainty.white.allFinite();
  if (!is_told || !(all > 0)) return {{Source::noise, half}};

  // the half width after each step, which takes one more property of the noise into account
  const double quantile = StudentQuantile(uncertainty.degrees_of_freedom, kIntervalLevel);
  const bool few = uncertainty.by_samples.size() > 0;
  const double before =
      few ? StudentQuantile(uncertainty.samples_degrees_of_freedom, kIntervalLevel) : quantile;
  const std::pair<Source, double> steps[] = {
      {Source::white_noise, before * deviation(uncertainty.white)},
      {Source::autocorrelated_noise,
       few ? before * deviation(uncertainty.by_samples) : quantile * all},
      {Source::few_segments, quantile * all}};
  return PartsOf(steps, half);
}

}  // namespace warmjoint
