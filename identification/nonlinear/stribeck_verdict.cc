#include "identification/nonlinear/stribeck_verdict.h"

#include <cmath>
#include <cstddef>

#include "identification/fit/fit_data.h"
#include "identification/linear/linear_laws.h"
#include "identification/linear/rigid_part.h"
#include "identification/model/least_squares.h"
#include "identification/sentences/falls.h"
#include "identification/sentences/fit.h"

namespace warmjoint {
namespace {

constexpr double kImpreciseLogVs = 0.5;       // standard deviation: 95 % within a factor of e
constexpr double kImpreciseFall = 0.5;        // standard deviation of ks - kc over itself
constexpr std::size_t kMostIterations = 100;  // why: of the solver (solve_by_ceres.h)

}  // namespace

std::string SlowSpeeds(const LogSamples& measurements, const Selection& selection) {
  // of all samples, where none is left
  const Eigen::VectorXd& all = measurements.velocity;
  const Eigen::VectorXd speed = selection.count() > 0 ? Kept(all, selection) : all;
  const double slowest = speed.cwiseAbs().minCoeff();
  return ExplainSlowSpeeds(slowest, slowest / 10, measurements.joint);
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
  return {Status::not_converged, ExplainUnconverged(kMostIterations), FrictionKind::stribeck};
}

Refusal NoFall(const FallingLaw& law, const LogSamples& measurements, const Selection& selection) {
  return {Status::not_identifiable, ExplainNoFall(law.rest(), SlowSpeeds(measurements, selection))};
}

StribeckEvidence EvidenceOf(const FallingLaw& law, const FallingPlaces& at,
                            const Eigen::VectorXd& x, const Uncertainty& uncertainty) {
  const Eigen::MatrixXd covariance = at.law().Block(uncertainty.covariance);
  return {law.fall.dot(at.law().Of(x)), std::sqrt(law.fall.dot(covariance * law.fall)),
          uncertainty.Deviation(at.log_vs())};
}

std::optional<std::string> UnidentifiableStribeck(const FallingLaw& law,
                                                  const StribeckEvidence& evidence,
                                                  const LogSamples& measurements,
                                                  const Selection& selection) {
  if (evidence.log_deviation < kImpreciseLogVs &&
      evidence.fall_deviation < kImpreciseFall * std::abs(evidence.fall)) {
    return std::nullopt;
  }
  // errors without a bound have no size that could be reported
  const double factor = std::exp(1.96 * evidence.log_deviation);
  if (!std::isfinite(factor) || !std::isfinite(evidence.fall_deviation)) {
    return NoFall(law, measurements, selection).message;
  }
  return ExplainVagueFall({.rest = law.rest(),
                           .fall = law.fall_words,
                           .half_width = 1.96 * evidence.fall_deviation,
                           .velocity_factor = factor},
                          SlowSpeeds(measurements, selection));
}

}  // namespace warmjoint
