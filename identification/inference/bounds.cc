#include "identification/inference/bounds.h"

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
#include "identification/model/normal_equations.h"
#include "identification/model/solve.h"
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
  const auto followed = Followed(logged, fit.rows.used, PartsOf(fit));
  return TorqueAlong(fit, followed ? followed->measurements : logged);
}

/// F of a fit along the motion of a log, at the samples that the fit used. [n] N.m or N
Eigen::VectorXd FrictionOver(const Fit& fit, const LogSamples& logged, const Selection& used) {
  const auto followed = Followed(logged, fit.rows.used, PartsOf(fit));
  const LogSamples& m = followed ? followed->measurements : logged;
  return Kept(FrictionAlong(fit, m).force, used);
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

/// Whether the value of a row of the law lies outside of its bounds, by chance or not.
bool LeavesBounds(const std::vector<Unknown>& parameters) {
  return std::ranges::any_of(parameters, [](const Unknown& one) {
    return IsNominal(one.role) && !(one.value >= one.lower && one.value <= one.upper);
  });
}

/// The rows of the law outside of their bounds.
std::vector<Excess> ExcessesOf(const Fit& fit, const Inference& by_noise) {
  std::vector<Excess> found;
  for (std::size_t i = 0; i < fit.parameters.size(); ++i) {
    const Unknown& row = fit.parameters[i];
    if (!IsNominal(row.role)) continue;
    if (const auto excess = FindExcess(row, by_noise.parameters[i])) found.push_back(*excess);
  }
  return found;
}

/// The estimated rows, of which those of the law alone have bounds, and x at their values.
Model BoundedRows(const std::vector<Unknown>& table) {
  Model rows;
  std::ranges::copy_if(table, std::back_inserter(rows.table), &Unknown::estimated);
  for (Unknown& row : rows.table) {
    if (IsNominal(row.role)) continue;
    row.lower = -kInfinity;
    row.upper = kInfinity;
  }
  return rows;
}

/// The minimum within the bounds of squares that are quadratic about the values of the table.
Minimum NearestWithin(const std::vector<Unknown>& table, const Uncertainty& uncertainty) {
  const Model rows = BoundedRows(table);
  const Eigen::VectorXd free = rows.Start();
  // of white noise where it is known: then a linear law is fitted as if the held rows were left out
  const bool white = uncertainty.white.rows() == free.size() && uncertainty.white.allFinite();
  const Eigen::MatrixXd h = InverseScaled(white ? uncertainty.white : uncertainty.covariance);
  SquaresProblem problem = WithinLimits(rows);
  problem.sums = [&](const Eigen::VectorXd& x) -> RowSums {
    const Eigen::VectorXd left = free - x, product = h * left;
    return {h, product, left.dot(product)};
  };
  return Minimise(problem, free.cwiseMax(problem.lower).cwiseMin(problem.upper));
}

/// The fit with its law within the bounds. measurements: of the fit
Fit HoldLaw(Fit fit, const LogSamples& measurements) {
  const bool stands = !fit.refusal && !IsRefused(fit.causes);
  if (!stands || !LeavesBounds(fit.parameters) || !fit.model.friction.maps.empty()) return fit;
  const Inference by_noise = Apply(ByNoise(fit), fit.causes);
  if (by_noise.status != Status::ok) return fit;
  auto left = FindLeftByNoise(fit, by_noise);
  if (!left) return fit;
  const Minimum nearest = NearestWithin(fit.parameters, by_noise.uncertainty);
  if (!nearest.converged) return fit;

  // the model of the fit follows, so that the residual is that of what is reported
  const Eigen::VectorXd before = TorqueOf(fit, measurements);
  Cause cause = HoldAt(nearest.x, nearest.at_bound, fit);
  cause.sentence = std::move(left->sentence);
  fit.rows.fitted += Kept(TorqueOf(fit, measurements) - before, fit.rows.used);
  fit.figures.end_energy = nullptr;
  fit.causes.push_back(std::move(cause));
  return fit;
}

}  // namespace

bool GivesFriction(const Fit& fit) {
  const bool stands = !fit.refusal && !IsRefused(fit.causes);
  return stands && !LeavesBounds(fit.parameters) && !RisesFromRest(fit.model.friction);
}

std::optional<Cause> BeyondBounds(const Fit& fit, const Inference& by_noise) {
  Cause cause{
      .source = Source::bound, .action = Action::refuse, .status = Status::inadequate_model};

  // parameters that could not be held at their bounds; friction that rises from rest has a sentence of its own
  for (const Excess& excess : ExcessesOf(fit, by_noise)) {
    if (excess.parameter.part == LawPart::rest_rise) continue;
    cause.sentence = ExplainExcess(excess, fit);
    return cause;
  }
  if (!RisesFromRest(fit.model.friction)) return std::nullopt;
  cause.sentence = ExplainRiseFromRest(fit);
  return cause;
}

std::optional<LeftByNoise> FindLeftByNoise(const Fit& fit, const Inference& by_noise) {
  const std::vector<Excess> outside = ExcessesOf(fit, by_noise);
  const auto by_chance = [](const Excess& one) { return one.interval95 && !one.beyond; };
  if (outside.empty() || !std::ranges::all_of(outside, by_chance)) return std::nullopt;
  LeftByNoise left{{}, {}, ExplainHeld(outside)};
  for (const Excess& one : outside) {
    const Unknown* const row = &one.parameter;
    left.columns.push_back(std::count_if(fit.parameters.data(), row,
                                         [](const Unknown& before) { return before.estimated; }));
    left.gaps.push_back(one.bound - row->value);
  }
  return left;
}

Cause HoldAt(const Eigen::VectorXd& x, const std::vector<Eigen::Index>& held, Fit& fit) {
  Cause cause{.source = Source::bound, .action = Action::hold};
  Eigen::Index column = 0;
  for (std::size_t i = 0; i < fit.parameters.size(); ++i) {
    Unknown& row = fit.parameters[i];
    if (!row.estimated) continue;
    const double before = row.value;
    row.value = row.ValueAt(x[column]);
    // exactly at the bound
    if (std::ranges::find(held, column++) != held.end()) {
      const bool below = std::abs(row.value - row.lower) <= std::abs(row.upper - row.value);
      row.value = below ? row.lower : row.upper;
    }
    cause.Add(i, row.value - before);
  }
  FollowTable(fit);
  return cause;
}

MakeFit WithinBounds(MakeFit make) {
  return [make = std::move(make)](const IdentifierInput& input) {
    return HoldLaw(make(input), input.measurements);
  };
}

Fit WithoutNegativeInertia(const MakeFit& make, const IdentifierInput& input) {
  Fit fit = make(input);
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
  const Eigen::VectorXd friction = FrictionOver(without, m, without.rows.used);
  const Eigen::VectorXd change = FrictionOver(fit, m, without.rows.used) - friction;
  cause.size = std::sqrt(change.squaredNorm() / static_cast<double>(change.size()));
  cause.sentence = ExplainHeldInertia(inertia, *interval, change.norm() / friction.norm());
  without.causes.push_back(std::move(cause));
  return without;
}

}  // namespace warmjoint
