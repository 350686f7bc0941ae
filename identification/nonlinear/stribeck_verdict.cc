#include "identification/nonlinear/stribeck_verdict.h"

#include <fmt/format.h>

#include <cmath>

#include "identification/fit_data.h"
#include "identification/linear/least_squares.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/rigid_part.h"

namespace warmjoint {
namespace {

constexpr double kImpreciseLogVs = 0.5;  // standard deviation: 95 % within a factor of e
constexpr double kImpreciseFall = 0.5;   // standard deviation of ks - kc over itself

}  // namespace

std::string SlowSpeeds(const LogSamples& measurements, const Selection& selection) {
  const Eigen::ArrayXd speed = Kept(measurements.velocity, selection).col(0).array().abs();
  const std::string_view unit = kVelocityUnit.For(measurements.joint);
  const double slowest = speed.minCoeff();
  return fmt::format(
      "the slowest constant speed is {:.3g} {}; hold several slower ones in both directions as "
      "well, down to about {:.2g} {}, or use a law without these parameters",
      slowest, unit, slowest / 10, unit);
}

std::optional<Refusal> UnknownSliding(const IdentifierInput& input, const FallingLaw& law,
                                      std::span<const ParameterInfo> unknown,
                                      const Eigen::MatrixXd& rigid) {
  const LogSamples& m = input.measurements;
  Eigen::MatrixXd columns = LawColumns(law.without, m.velocity);
  if (rigid.cols() > 0) columns = ConcatColumns(columns, rigid);
  const LeastSquares sliding =
      SolveLeastSquares(Kept(columns, input.selection), Kept(m.torque, input.selection));
  if (sliding.rank == columns.cols()) return std::nullopt;
  std::vector<std::string> names;
  for (const ParameterInfo& info : unknown) names.emplace_back(info.name);
  return Refusal{Status::not_identifiable, Indistinct(names, m, input.selection)};
}

Refusal NotConverged() {
  return {Status::not_converged, "the fit has not converged after 100 iterations",
          FrictionKind::stribeck};
}

Refusal NoFall(const FallingLaw& law, const LogSamples& measurements, const Selection& selection) {
  return {Status::not_identifiable,
          fmt::format("{} and stribeck_velocity cannot be distinguished from coulomb; {}",
                      law.rest(), SlowSpeeds(measurements, selection))};
}

StribeckEvidence EvidenceOf(const FallingLaw& law, const Layout& at, const Eigen::VectorXd& x,
                            const Uncertainty& known) {
  const Eigen::MatrixXd covariance = at.law.Block(known.covariance);
  return {law.fall.dot(at.law.Of(x)), std::sqrt(law.fall.dot(covariance * law.fall)),
          known.Deviation(at.log_vs())};
}

std::optional<std::string> UnidentifiableStribeck(const FallingLaw& law,
                                                  const StribeckEvidence& evidence,
                                                  const LogSamples& measurements,
                                                  const Selection& selection) {
  if (evidence.log_deviation < kImpreciseLogVs &&
      evidence.fall_deviation < kImpreciseFall * std::abs(evidence.fall)) {
    return std::nullopt;
  }
  // errors without a bound have no size to tell
  const double factor = std::exp(1.96 * evidence.log_deviation);
  if (!std::isfinite(factor) || !std::isfinite(evidence.fall_deviation)) {
    return NoFall(law, measurements, selection).message;
  }
  return fmt::format(
      "{} and stribeck_velocity cannot be distinguished: stribeck_velocity is known to a factor of "
      "{:.3g} only, {} to {:.3g}; {}",
      law.rest(), factor, law.fall_words, 1.96 * evidence.fall_deviation,
      SlowSpeeds(measurements, selection));
}

}  // namespace warmjoint
