#include "identification/sentences/fit.h"

#include <fmt/format.h>

namespace warmjoint {
namespace {

std::string NameOfFirstPart(double held_out) {
  return fmt::format("the first {:.3g} % of the log", 100 * (1 - held_out));
}

}  // namespace

std::string NameOfSamples(const FittedSamples& samples) {
  return fmt::format("{} samples{}{}{}", samples.count,
                     samples.is_any_motion ? " of motion of any kind, with inertia" : "",
                     samples.is_lagged ? " with a lag of the torque" : "",
                     samples.is_whitened ? ", whitened" : "");
}

std::string SummaryOfLeastSquares(std::string_view law, const FittedSamples& samples) {
  return fmt::format("law {} by least squares on {}", law, NameOfSamples(samples));
}

std::string SummaryOfLikelihood(const FittedSamples& samples, std::size_t iterations) {
  return fmt::format("maximum likelihood on {}, refined in {} iterations", NameOfSamples(samples),
                     iterations);
}

std::string SummaryOfForgetting(std::string_view law, double remembered, Eigen::Index samples) {
  return fmt::format("law {} as the last {:.0f} of {} samples show it", law, remembered, samples);
}

std::string SummaryOfFilter(std::size_t passes, Eigen::Index samples, double energy,
                            std::string_view unit) {
  return fmt::format("filtered in {} passes over {} samples; at the end E is {:.4g} {}", passes,
                     samples, energy, unit);
}

std::string ExplainOutliers(Eigen::Index outliers, Eigen::Index samples, double deviations) {
  return fmt::format(
      "; {} of {} samples lie more than {:.0f} standard deviations off, and Huber's loss bounds "
      "their pull",
      outliers, samples, deviations);
}

std::string ExplainColour(double correlation) {
  return fmt::format(
      "; noise is coloured (correlation {:.2f} between neighbours), which the intervals account "
      "for",
      correlation);
}

std::string ExplainUnevenness(double errors) {
  return fmt::format(
      "; the noise is uneven (its variance changes with torque or time, {:.2g} standard errors "
      "beyond chance), which the intervals account for",
      errors);
}

std::string ExplainUnconverged(std::size_t iterations) {
  return fmt::format("the fit has not converged after {} iterations", iterations);
}

std::string ExplainArrived(std::size_t iterations, double rate, double remaining) {
  return fmt::format(
      "converged: after {} iterations, at a rate of {:.4f}, the parameters are within {:.2g} % of "
      "where they go",
      iterations, rate, 100 * remaining);
}

std::string ExplainStopped(std::size_t iterations, double rate, double remaining,
                           double tolerance) {
  return fmt::format(
      "stopped after {} iterations while the parameters still move: at the observed rate of {:.4f} "
      "an iteration they end up to {:.2g} % from here (tolerance {:.2g} %); give more iterations, "
      "or try --identifier energy-ml",
      iterations, rate, 100 * remaining, 100 * tolerance);
}

std::string ExplainStructure(std::string_view name, double deviations, Action action) {
  const bool drops = action == Action::drop_intervals;
  return fmt::format(
      "{}: treating its slow part as noise would change {} by {:.2g} standard errors{}",
      drops ? "no intervals are given, since the residual holds structure and not only noise"
            : "the residual is not only noise",
      name, deviations, drops ? "" : "; intervals were widened to cover this");
}

std::string ExplainShortParts(double held_out) {
  return fmt::format("{}, or the rest, hold fewer than two samples", NameOfFirstPart(held_out));
}

std::string ExplainNoFrictionBefore(double held_out, std::string_view why) {
  return fmt::format("a fit to {} gives no friction ({})", NameOfFirstPart(held_out), why);
}

std::string ExplainNotHeldOut(double held_out, std::string_view why) {
  return fmt::format("of the last {:.3g} % of the log, {}", 100 * held_out, why);
}

std::string ExplainNotPredicted(std::string_view source, std::string_view why) {
  return fmt::format("of {}, {}", source, why);
}

}  // namespace warmjoint
