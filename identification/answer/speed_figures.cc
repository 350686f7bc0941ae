#include "identification/answer/speed_figures.h"

#include <algorithm>
#include <cmath>

#include "identification/fit/fit_data.h"
#include "identification/inference/apply.h"
#include "identification/sentences/friction.h"
#include "identification/sentences/log.h"
#include "identification/typical_speeds.h"
#include "identification/uncertainty/tails.h"
#include "models/friction/sign.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Converts derivatives by the table's rows to those by the coordinates of the estimated rows. [p]
VectorXd ByCoordinates(const Fit& fit, const VectorXd& derivatives) {
  std::vector<double> slopes;
  for (size_t i = 0; i < fit.parameters.size(); ++i) {
    const Unknown& row = fit.parameters[i];
    if (!row.estimated) continue;
    slopes.push_back(derivatives[static_cast<Index>(i)] * row.ValueByCoordinate(row.value));
  }
  return Eigen::Map<const VectorXd>(slopes.data(), std::ssize(slopes));
}

/// Quantile for the fewest degrees of freedom of the coordinates that count.
double QuantileFor(const Uncertainty& uncertainty, const VectorXd& slopes) {
  double fewest = uncertainty.degrees_of_freedom;
  if (uncertainty.each_degrees_of_freedom.size() == slopes.size()) {
    fewest = kInfinity;
    for (Index j = 0; j < slopes.size(); ++j) {
      if (slopes[j] != 0) fewest = std::min(fewest, uncertainty.DegreesOfFreedom(j));
    }
  }
  return StudentQuantile(fewest, kIntervalLevel);
}

/// The friction that the heat of one moment adds, with its derivatives by the table's rows.
struct WarmMoment {
  double energy = 0;  // E, N.m or N
  VectorXd derivatives;
};

/// The moment of the kept sample with the largest |E|; nothing where no heat was fitted.
std::optional<WarmMoment> WarmestOf(const Fit& fit, const FittedModel& model, const LogSamples& m) {
  if (!model.loop) return std::nullopt;
  Index warmest = -1;
  for (Index i = 0; i < m.size(); ++i) {
    if (!model.selection.keep[i] || Sign(m.velocity[i]) == 0) continue;
    if (warmest < 0 || std::abs(model.energy[i]) > std::abs(model.energy[warmest])) warmest = i;
  }
  if (warmest < 0) return std::nullopt;

  // F = Fn + sign(v) E: what the heat adds to the derivatives of Fn
  VectorXd along = model.derivatives.row(warmest).head(model.of_friction);
  along.head(model.cold.cols()) -= model.cold.row(warmest).transpose();
  WarmMoment moment{model.energy[warmest], VectorXd::Zero(std::ssize(fit.parameters))};
  for (Index j = 0; j < along.size(); ++j) {
    moment.derivatives[static_cast<Index>(model.rows[static_cast<size_t>(j)])] =
        Sign(m.velocity[warmest]) * along[j];
  }
  return moment;
}

/// One figure; nothing where its error is not known.
std::optional<SpeedFigure> FigureOf(const Fit& fit, const Inference& inferred, const LogSamples& m,
                                    double speed, double value, VectorXd derivatives,
                                    std::optional<double> energy) {
  const VectorXd slopes = ByCoordinates(fit, derivatives);
  const Uncertainty& uncertainty = inferred.uncertainty;
  if (uncertainty.covariance.rows() != slopes.size()) return std::nullopt;
  const double variance = slopes.dot(uncertainty.covariance * slopes);
  if (!std::isfinite(variance)) return std::nullopt;
  const double deviation = std::sqrt(std::max(variance, 0.0));
  const double half = QuantileFor(uncertainty, slopes) * deviation;
  return SpeedFigure{{speed,
                      value,
                      deviation,
                      {value - half, value + half},
                      std::string(kVelocityUnit.For(m.joint)),
                      m.torque_unit,
                      energy},
                     std::move(derivatives),
                     NoiseParts(uncertainty, slopes, half)};
}

/// Derivatives of the resistance at a speed and under a load by the rows of law and load in the table. [P]
VectorXd ColdDerivatives(const Fit& fit, double speed, double load = 0) {
  const Eigen::MatrixXd by_row =
      NominalDerivatives(fit, VectorXd::Constant(1, speed), VectorXd::Constant(1, load));
  VectorXd derivatives = VectorXd::Zero(std::ssize(fit.parameters));
  Index j = 0;
  for (size_t i = 0; i < fit.parameters.size() && j < by_row.cols(); ++i) {
    if (!IsNominal(fit.parameters[i].role)) continue;
    derivatives[static_cast<Index>(i)] = Sign(speed) * by_row(0, j++);
  }
  return derivatives;
}

/// The figures of a fit that has them already, since its table has only the law.
std::vector<SpeedFigure> OfItsOwn(const Fit& fit, const LogSamples& m) {
  std::vector<SpeedFigure> all;
  for (const FrictionAtSpeed& one : fit.figures.friction_at_speeds) {
    VectorXd derivatives = fit.figures.fields ? fit.figures.fields->at_speeds_by_rows[all.size()]
                                              : ColdDerivatives(fit, one.speed);
    SpeedFigure& figure = all.emplace_back(SpeedFigure{one, std::move(derivatives)});
    figure.at.speed_unit = kVelocityUnit.For(m.joint);
    figure.at.unit = m.torque_unit;
    if (fit.model.friction.thermal && !figure.at.energy) figure.at.energy = 0;
    figure.parts =
        fit.figures.fields
            ? FieldParts(fit.figures.fields->at_speeds_up_to[all.size() - 1], figure.HalfWidth())
            : std::vector<WidthPart>{{Source::noise, figure.HalfWidth()}};
  }
  return all;
}

}  // namespace

std::vector<SpeedFigure> SpeedFiguresOf(const Fit& fit, const Inference& inferred,
                                        const std::optional<FittedModel>& model,
                                        const LogSamples& m, const Selection& selection) {
  if (inferred.status != Status::ok || !inferred.gives_friction) return {};
  if (DropIntervals(inferred.causes)) return {};
  if (!fit.model.friction.maps.empty() || fit.figures.fields) return OfItsOwn(fit, m);

  // cold, then warm
  std::optional<WarmMoment> warmest;
  if (model) warmest = WarmestOf(fit, *model, m);
  const Law& law = *FindLaw(fit.model.friction.law);
  const std::vector<double> values = LawValues(fit.model.friction);
  const std::optional<double> cold = fit.model.friction.thermal ? std::optional(0.0) : std::nullopt;
  std::vector<SpeedFigure> all;
  const auto add = [&](std::optional<SpeedFigure> figure) {
    if (figure) all.push_back(*std::move(figure));
  };
  const std::vector<SpeedGroup> groups = TypicalSpeeds(Kept(m.velocity, selection));
  const auto resistance = [&](double v, double load) {
    return Sign(v) * law.force(v, values.data()) + fit.model.friction.load_gain * load;
  };
  const std::vector<double> loads =
      MeanLoads(groups, fit.RowOf(Role::load) ? Kept(*m.load, selection) : VectorXd());
  for (size_t i = 0; i < groups.size(); ++i) {
    const double v = groups[i].velocity, load = loads[i];
    add(FigureOf(fit, inferred, m, v, resistance(v, load), ColdDerivatives(fit, v, load), cold));
  }
  for (size_t i = 0; warmest && i < groups.size(); ++i) {
    const double v = groups[i].velocity, load = loads[i];
    add(FigureOf(fit, inferred, m, v, resistance(v, load) + warmest->energy,
                 ColdDerivatives(fit, v, load) + warmest->derivatives, warmest->energy));
  }
  return all;
}

void NameOneSpeed(const LogSamples& m, const Selection& selection, Fit& fit) {
  if (fit.refusal || !fit.model.friction.maps.empty()) return;
  // a law of levels alone, for which all speeds are one
  const auto is_of_law = [](const Unknown& row) { return row.role == Role::law; };
  const bool is_level = std::ranges::all_of(fit.parameters, [&](const Unknown& row) {
    return !is_of_law(row) || row.part == LawPart::level;
  });
  if (!is_level) return;
  const std::vector<SpeedGroup> groups = TypicalSpeeds(Kept(m.velocity, selection));
  for (size_t i = 1; i < groups.size(); ++i) {
    if (Sign(groups[i].velocity) == Sign(groups[i - 1].velocity)) return;
  }
  if (groups.empty()) return;

  std::vector<std::string> names;
  for (Unknown& row : fit.parameters) {
    if (!is_of_law(row)) continue;
    row.has_interval = false;
    names.push_back(row.name);
  }
  std::vector<double> speeds;
  for (const SpeedGroup& group : groups) speeds.push_back(group.velocity);
  fit.causes.push_back(
      Note(ExplainOneSpeed(names, speeds, std::string(kVelocityUnit.For(m.joint)))));
}

std::optional<Cause> UnknownFriction(const std::vector<SpeedFigure>& at_speeds,
                                     const std::vector<Cause>& causes) {
  std::vector<size_t> unknown;
  std::vector<FrictionAtSpeed> left_out;
  size_t counted = 0;
  for (size_t i = 0; i < at_speeds.size(); ++i) {
    const SpeedFigure& one = at_speeds[i];
    const FigureChange change = ChangeOf(causes, one.derivatives, About::friction);
    if (!change.has_interval) continue;
    ++counted;
    FrictionAtSpeed moved = one.at;
    Move(change, moved.value, moved.interval95);
    if (0.5 * (moved.interval95[1] - moved.interval95[0]) < std::abs(moved.value)) continue;
    unknown.push_back(i);
    left_out.push_back(moved);
  }
  if (unknown.empty()) return std::nullopt;
  if (unknown.size() < counted) {
    return Cause{.source = Source::unknown_friction,
                 .without_speed = std::move(unknown),
                 .sentence = ExplainLeftOutSpeeds(left_out)};
  }
  return Cause{.source = Source::unknown_friction,
               .action = Action::refuse,
               .status = Status::not_identifiable,
               .sentence = ExplainUnknownFriction(left_out)};
}

}  // namespace warmjoint
