#include "identification/inference/bounds.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "identification/fit_data.h"
#include "identification/forward/log_course.h"
#include "identification/linear/command.h"
#include "identification/physical_bounds.h"
#include "models/friction/parameter_rows.h"

namespace warmjoint {
namespace {

/// A parameter beside the bound that its value lies outside of.
struct Excess {
  const FitParameter& parameter;
  const ParameterInterval& known;
  double bound = 0;
  bool below = false;   // the bound; else above
  bool beyond = false;  // with its whole 95 % interval
};

std::optional<Excess> FindExcess(const FitParameter& parameter, const ParameterInterval& known) {
  // a value that is no number counts as below
  const bool below = !(parameter.value >= parameter.lower);
  if (!below && parameter.value <= parameter.upper) return std::nullopt;
  const double bound = below ? parameter.lower : parameter.upper;
  const auto& interval = known.interval95;
  // beyond doubt where no part of the interval is within the bound
  const bool beyond = interval && (below ? (*interval)[1] < bound : (*interval)[0] > bound);
  return Excess{parameter, known, bound, below, beyond};
}

std::vector<Excess> FindExcesses(const Fit& fit, const Inference& inference) {
  std::vector<Excess> excesses;
  for (size_t i = 0; i < fit.parameters.size(); ++i) {
    if (fit.parameters[i].role != Role::law) continue;
    if (auto one = FindExcess(fit.parameters[i], inference.parameters[i])) excesses.push_back(*one);
  }
  return excesses;
}

/// "viscous is -0.3 N.m.s/rad, below its bound 0, with its whole 95 % interval, -0.4 to -0.2".
std::string Words(const Excess& excess) {
  const auto& interval = excess.known.interval95;
  const std::string reach =
      !interval ? ", with no interval that could tell whether by chance"
                : fmt::format(", {} 95 % interval, {:.3g} to {:.3g}",
                              excess.beyond ? "with its whole" : "but for a part of its",
                              (*interval)[0], (*interval)[1]);
  return fmt::format("{} is {:.4g} {}, {} its bound {}{}", excess.parameter.name,
                     excess.parameter.value, excess.parameter.unit,
                     excess.below ? "below" : "above", excess.bound, reach);
}

bool Warms(const Fit& fit) { return fit.RowOf(Role::heat).has_value(); }

/// The identifier of the linear laws that knows as much of warming as a fit does.
std::string_view Linear(const Fit& fit) { return Warms(fit) ? "energy-ml" : "nominal-ls"; }

/// What to try against friction that falls with speed: what the fit has of curve and warming is not
/// named again.
std::string RemedyForFallingSlope(const Fit& fit) {
  const std::string& law = fit.friction.law;
  // whether the law has a Stribeck curve already
  const bool curved = fit.friction.parameters.contains(std::string(kStribeckVelocityRow.name));
  if (curved && Warms(fit)) {
    return "friction falls with speed beyond the law's curve and its warming: record higher speeds";
  }
  if (curved) {
    return "friction that falls with speed beyond the law's curve is warming: try --identifier " +
           CurveCommand(law, "estimated").Text();
  }
  if (Warms(fit)) {
    return "friction that falls with speed is a Stribeck effect: try --identifier " +
           CurveCommand(law, "estimated").Text();
  }
  return fmt::format(
      "friction that falls with speed is warming, or a Stribeck effect: try --identifier {}, or "
      "--identifier {} where the joint does not warm",
      LinearCommand("energy-ml", law).Text(), CurveCommand(law, "none").Text());
}

/// What makes a fit leave its bounds, and what to try.
std::string Remedy(const Fit& fit, const FitParameter& parameter) {
  if (parameter.part == LawPart::slope) return RemedyForFallingSlope(fit);
  // neither slope nor level: a linear law may do without it
  if (parameter.part != LawPart::level) {
    return fmt::format("try --identifier {}", LinearCommand(Linear(fit), fit.friction.law).Text());
  }
  const char* push = "a negative level would push the joint: ";
  // gravity is fitted already, which leaves the sign as a cause
  if (fit.gravity)
    return fmt::format("{}is the sign of the torque reversed (--scale torque=-1)?", push);
  return fmt::format(
      "{}does the torque hold gravity or another load (try --identifier {} --gravity paired), or "
      "is "
      "its sign reversed (--scale torque=-1)?",
      push, Linear(fit));
}

bool IsRise(const FitParameter& parameter) { return parameter.part == LawPart::rest_rise; }

}  // namespace

std::optional<Cause> BeyondBounds(const Fit& fit, const Inference& by_noise) {
  const std::string& law = fit.friction.law;
  const std::vector<Excess> excesses = FindExcesses(fit, by_noise);
  Cause cause{
      .source = Source::bound, .action = Action::refuse, .status = Status::inadequate_model};

  // what could not be held at its bound; that friction rises from rest has words of its own
  const auto sure = std::ranges::find_if(
      excesses, [](const Excess& excess) { return !IsRise(excess.parameter); });
  if (sure != excesses.end()) {
    cause.sentence = fmt::format("{}: law {} does not describe these data; {}", Words(*sure), law,
                                 Remedy(fit, sure->parameter));
    return cause;
  }
  const auto rises = RisesFromRest(fit.friction);
  if (!rises) return std::nullopt;
  cause.sentence = fmt::format(
      "{}: friction rises from rest with speed, where law {} lets it fall; try "
      "--identifier {} --set law={}",
      *rises, law, Linear(fit), HasLevelForEachDirection(law) ? "asymmetric" : "viscous_coulomb");
  return cause;
}

namespace {

/// F + G + M a by the friction and what stands beside it. [N] N.m or N
Eigen::VectorXd TorqueOf(const Fit& fit, const LogSamples& m) {
  Eigen::VectorXd torque = PredictFriction(fit.friction, m, fit.Start()).force;
  if (fit.gravity) torque += fit.gravity->Torque(m.position);
  if (fit.inertia && m.acceleration) torque += *fit.inertia * *m.acceleration;
  return torque;
}

/// Moves the table by changes of x, [p], and the model by it.
void Move(const Eigen::VectorXd& moves, Fit& fit) {
  Eigen::Index column = 0, gravity = 0;
  for (FitParameter& row : fit.parameters) {
    if (!row.estimated) continue;
    const double move = moves[column++], before = row.value;
    const bool heat = row.role == Role::heat, tau = row.coordinate == Coordinate::logarithm;
    row.value = tau ? before * std::exp(move) : before + move;
    // exactly at the bound
    if (row.role == Role::law) row.value = std::clamp(row.value, row.lower, row.upper);
    row.moved = row.value - before;
    if (row.role == Role::law) fit.friction.parameters[row.name] = row.value;
    if (heat) (tau ? fit.friction.thermal->time_constant : fit.friction.thermal->gain) = row.value;
    if (row.role == Role::start) fit.initial_energy = row.value;
    if (row.role == Role::gravity) fit.gravity->values[gravity++] = row.value;
    if (row.role == Role::inertia) fit.inertia = row.value;
  }
}

}  // namespace

void HoldAtBounds(const Inference& told, const LogSamples& measurements, Fit& fit) {
  // free gravity and maps have weights beside the table, which would have to follow
  const bool free = fit.gravity && fit.gravity->kind == GravityKind::paired;
  if (free || !fit.friction.maps.empty()) return;
  std::vector<Eigen::Index> held;
  std::vector<double> gaps;
  Eigen::Index column = -1;
  for (size_t i = 0; i < fit.parameters.size(); ++i) {
    const FitParameter& row = fit.parameters[i];
    column += row.estimated;
    const auto excess = row.role == Role::law ? FindExcess(row, told.parameters[i]) : std::nullopt;
    if (!excess) continue;
    if (excess->beyond || !excess->known.interval95) return;
    held.push_back(column);
    gaps.push_back(excess->bound - row.value);
    fit.causes.push_back(Remark(
        fmt::format("{}: noise may do that, so it is set to {}", Words(*excess), excess->bound)));
  }

  // the others as the covariance has them with these held
  const Eigen::MatrixXd& covariance = told.known.covariance;
  const Eigen::Map<const Eigen::VectorXd> gap(gaps.data(), static_cast<Eigen::Index>(gaps.size()));
  const Eigen::VectorXd before = TorqueOf(fit, measurements);
  Move(covariance(Eigen::all, held) * covariance(held, held).eval().ldlt().solve(gap), fit);
  fit.fitted += Kept(TorqueOf(fit, measurements) - before, fit.used);
  fit.end_energy = nullptr;
}

}  // namespace warmjoint
