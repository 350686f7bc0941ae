#include "identification/inference/bounds.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "identification/fit/fit_along.h"
#include "identification/fit/fit_data.h"
#include "identification/fit/fit_parameters.h"
#include "identification/fit/seen_samples.h"
#include "identification/forward/log_trajectory.h"
#include "identification/inference/apply.h"
#include "identification/sentences/friction.h"
#include "identification/sentences/law.h"
#include "models/friction/parameter_rows.h"

namespace warmjoint {
namespace {

std::optional<Excess> FindExcess(const Unknown& parameter, const ParameterInterval& estimated) {
  // a value that is not a number counts as below
  const bool below = !(parameter.value >= parameter.lower);
  if (!below && parameter.value <= parameter.upper) return std::nullopt;
  const double bound = below ? parameter.lower : parameter.upper;
  const auto& interval = estimated.interval95;
  // beyond doubt where no part of the interval is within the bound
  const bool beyond = interval && (below ? (*interval)[1] < bound : (*interval)[0] > bound);
  return Excess{parameter, interval, bound, below, beyond};
}

/// Whether the level at rest is below that of sliding, of a law that has both.
bool RisesFromRest(const Friction& friction) {
  const auto at_rest = friction.parameters.find(std::string(kStaticRow.name));
  const auto coulomb = friction.parameters.find(std::string(kCoulombRow.name));
  const auto rise = friction.parameters.find(std::string(kStaticRiseRow.name));
  const auto none = friction.parameters.end();
  // a law has its rise from rest as a parameter of its own, or as two levels
  if (rise != none && rise->second < 0) return true;
  return at_rest != none && coulomb != none && at_rest->second < coulomb->second;
}

/// F + G + M a of a fit along the motion of a log. [N] N.m or N
Eigen::VectorXd TorqueOf(const Fit& fit, const LogSamples& logged) {
  const auto followed = Followed(logged, fit.used, PartsOf(fit));
  return TorqueAlong(fit, followed ? followed->measurements : logged);
}

/// F of a fit along the motion of a log, at the samples that the fit used. [n] N.m or N
Eigen::VectorXd FrictionOver(const Fit& fit, const LogSamples& logged, const Selection& used) {
  const auto followed = Followed(logged, fit.used, PartsOf(fit));
  const LogSamples& m = followed ? followed->measurements : logged;
  return Kept(PredictFriction(fit.friction, m, fit.Start()).force, used);
}

/// The 95 % interval of an inertia that was fitted and lies below 0 with the whole of it.
std::optional<std::array<double, 2>> IntervalBelowZero(const Fit& fit, std::size_t inertia) {
  const Unknown& row = fit.parameters[inertia];
  if (!row.estimated || !(row.value < 0)) return std::nullopt;
  const Inference inferred = Apply(ByNoise(fit), fit.causes);
  if (inferred.status != Status::ok) return std::nullopt;
  const auto& interval = inferred.parameters[inertia].interval95;
  return interval && (*interval)[1] < 0 ? interval : std::nullopt;
}

/// Changes the table by changes of x, [p], and the model with it. Returns the row of the values that changed.
Cause Move(const Eigen::VectorXd& moves, Fit& fit) {
  Cause cause{.source = Source::bound, .action = Action::hold};
  Eigen::Index column = 0;
  for (std::size_t i = 0; i < fit.parameters.size(); ++i) {
    Unknown& row = fit.parameters[i];
    if (!row.estimated) continue;
    const double move = moves[column++], before = row.value;
    row.value = row.coordinate == Coordinate::logarithm ? before * std::exp(move) : before + move;
    // exactly at the bound
    if (IsNominal(row.role)) row.value = std::clamp(row.value, row.lower, row.upper);
    cause.Add(i, row.value - before);
  }
  FollowTable(fit);
  return cause;
}

}  // namespace

bool LeavesBounds(const std::vector<Unknown>& parameters) {
  return std::ranges::any_of(parameters, [](const Unknown& one) {
    return IsNominal(one.role) && !(one.value >= one.lower && one.value <= one.upper);
  });
}

bool GivesFriction(const Fit& fit) {
  const bool stands = !fit.refusal && !IsRefused(fit.causes);
  return stands && !LeavesBounds(fit.parameters) && !RisesFromRest(fit.friction);
}

std::optional<Cause> BeyondBounds(const Fit& fit, const Inference& by_noise) {
  Cause cause{
      .source = Source::bound, .action = Action::refuse, .status = Status::inadequate_model};

  // parameters that could not be held at their bounds; friction that rises from rest has a sentence of its own
  for (size_t i = 0; i < fit.parameters.size(); ++i) {
    const Unknown& row = fit.parameters[i];
    if (!IsNominal(row.role) || row.part == LawPart::rest_rise) continue;
    const auto excess = FindExcess(row, by_noise.parameters[i]);
    if (!excess) continue;
    cause.sentence = ExplainExcess(*excess, fit);
    return cause;
  }
  if (!RisesFromRest(fit.friction)) return std::nullopt;
  cause.sentence = ExplainRiseFromRest(fit);
  return cause;
}

void HoldActiveBounds(const Inference& by_noise, const LogSamples& measurements, Fit& fit) {
  // free gravity and maps have weights outside of the table, which would have to be fitted again
  const bool free = fit.gravity && fit.gravity->kind == GravityKind::paired;
  if (free || !fit.friction.maps.empty()) return;
  std::vector<Eigen::Index> held;
  std::vector<double> gaps;
  std::vector<Excess> beyond;
  Eigen::Index column = -1;
  for (size_t i = 0; i < fit.parameters.size(); ++i) {
    const Unknown& row = fit.parameters[i];
    column += row.estimated;
    const auto excess =
        IsNominal(row.role) ? FindExcess(row, by_noise.parameters[i]) : std::nullopt;
    if (!excess) continue;
    if (excess->beyond || !excess->interval95) return;
    held.push_back(column);
    gaps.push_back(excess->bound - row.value);
    beyond.push_back(*excess);
  }
  // the other parameters, by the covariance, with these held
  const Eigen::MatrixXd& covariance = by_noise.uncertainty.covariance;
  const Eigen::Map<const Eigen::VectorXd> gap(gaps.data(), static_cast<Eigen::Index>(gaps.size()));
  const Eigen::VectorXd before = TorqueOf(fit, measurements);
  Cause cause =
      Move(covariance(Eigen::all, held) * covariance(held, held).eval().ldlt().solve(gap), fit);
  cause.sentence = ExplainHeld(beyond);
  fit.fitted += Kept(TorqueOf(fit, measurements) - before, fit.used);
  fit.end_energy = nullptr;
  fit.causes.push_back(std::move(cause));
}

Fit WithoutNegativeInertia(Fit fit, const IdentifierInput& input, const MakeFit& make) {
  const auto row = fit.RowOf(Role::inertia);
  if (fit.refusal || IsRefused(fit.causes) || !row) return fit;
  const auto interval = IntervalBelowZero(fit, *row);
  if (!interval) return fit;
  Fit without = make(input.With(WithoutInertia(input.options)));
  const Unknown& inertia = fit.parameters[*row];
  if (without.refusal) {
    fit.causes.push_back(
        Invalidate(Status::inadequate_model, ExplainNegativeInertia(inertia, *interval)));
    return fit;
  }

  // what the inertia changes of law and heat, and of the friction along the log
  Cause cause{.source = Source::findings, .action = Action::widen};
  for (std::size_t i = 0; i < without.parameters.size(); ++i) {
    const Unknown& one = without.parameters[i];
    const auto other = std::ranges::find(fit.parameters, one.name, &Unknown::name);
    if (!one.estimated || one.name.empty() || other == fit.parameters.end()) continue;
    cause.Add(i, other->value - one.value);
  }
  const LogSamples& m = input.measurements;
  const Eigen::VectorXd friction = FrictionOver(without, m, without.used);
  const Eigen::VectorXd change = FrictionOver(fit, m, without.used) - friction;
  cause.size = std::sqrt(change.squaredNorm() / static_cast<double>(change.size()));
  cause.sentence = ExplainHeldInertia(inertia, *interval, change.norm() / friction.norm());
  without.causes.push_back(std::move(cause));
  return without;
}

Fit FitWithinBounds(const MakeFit& make, const IdentifierInput& input) {
  return EnforceBounds(WithoutNegativeInertia(make(input), input, make), input.measurements);
}

}  // namespace warmjoint
