#include "identification/adequacy/fitted_model.h"

#include <algorithm>
#include <cmath>

#include "identification/adequacy/held_loss.h"
#include "identification/forward/closed_loop.h"
#include "identification/forward/predict.h"
#include "identification/linear/fit_gravity.h"
#include "identification/linear/linear_laws.h"
#include "identification/warming/gaps.h"

namespace warmjoint::inline identification {
namespace {

/// The friction that the estimate describes, or, where its values lie outside of their bounds and
/// it describes none, the one that they would be. Nothing where values are missing.
std::optional<FrictionDescription> Described(const Identifier& identifier,
                                             const IdentifierInput& input,
                                             const Estimate& estimate) {
  if (estimate.friction) return estimate.friction;
  const Law* law = HasOption(identifier, "law") ? FindLaw(input.options.Text("law")) : nullptr;
  if (!law) return std::nullopt;
  FrictionDescription friction;
  friction.law = law->name;
  friction.gear = input.measurements.gear;
  for (const ParameterInfo& info : law->parameters) {
    const EstimatedParameter* found = estimate.Find(info.name);
    if (!found) return std::nullopt;
    friction.parameters[found->name] = found->value;
  }
  const EstimatedParameter* gain = estimate.Find("thermal_gain");
  const EstimatedParameter* tau = estimate.Find("thermal_time_constant");
  if (gain && tau) friction.thermal = Thermal{gain->value, tau->value};
  return friction;
}

/// dFn/dp, by central differences where the law is not linear in p. [N x d]
Eigen::MatrixXd NominalDerivatives(const Law& law, const std::vector<double>& values,
                                   const Eigen::VectorXd& velocity) {
  if (IsLinear(law)) return LawColumns(law, velocity);
  Eigen::MatrixXd derivatives(velocity.size(), static_cast<Eigen::Index>(values.size()));
  for (size_t i = 0; i < values.size(); ++i) {
    const double step = 1e-5 * (std::abs(values[i]) + 1e-3);
    std::vector<double> above = values, below = values;
    above[i] += step;
    below[i] -= step;
    for (Eigen::Index n = 0; n < velocity.size(); ++n) {
      derivatives(n, static_cast<Eigen::Index>(i)) =
          (law.force(velocity[n], above.data()) - law.force(velocity[n], below.data())) /
          (2 * step);
    }
  }
  return derivatives;
}

/// What maps add to law and warming. [N]
Eigen::VectorXd MapForce(const Law& law, const std::vector<double>& values, const Measurements& m,
                         const Prediction& prediction) {
  Eigen::VectorXd force = prediction.force;
  for (Eigen::Index i = 0; i < force.size(); ++i) {
    const double v = m.velocity[i];
    force[i] -= WarmForce(v, law.force(v, values.data()), prediction.energy[i]);
  }
  return force;
}

void TakeOff(const GravityModel& gravity, const Eigen::VectorXd& position, FittedModel& model) {
  model.torque -= gravity.Torque(position);
  for (Eigen::Index i = 0; i < position.size(); ++i) {
    model.selection.keep[i] = model.selection.keep[i] && gravity.Covers(position[i]);
  }
}

/// Gravity's few values join the parameters. The many of `paired` do not: what depends on position
/// alike in both directions is theirs, and the other features average out over it.
void AddGravity(const GravityModel& gravity, const Eigen::VectorXd& position, FittedModel& model) {
  if (gravity.kind == GravityKind::paired) return;
  model.derivatives =
      Beside(model.derivatives, GravityColumns(gravity.kind, gravity.knots, position));
  if (gravity.kind == GravityKind::constant) {
    model.names.emplace_back("gravity_offset");
  } else {
    model.names.insert(model.names.end(), {"gravity_sine", "gravity_cosine"});
  }
}

}  // namespace

bool HasOption(const Identifier& identifier, std::string_view name) {
  return std::any_of(identifier.options.begin(), identifier.options.end(),
                     [name](const OptionInfo& option) { return option.name == name; });
}

bool FittedModel::KnowsWarming() const {
  return std::find(names.begin(), names.end(), "thermal_gain") != names.end();
}

std::optional<FittedModel> EvaluateModel(const Identifier& identifier, const IdentifierInput& input,
                                         const Estimate& estimate) {
  const std::optional<FrictionDescription> friction = Described(identifier, input, estimate);
  if (!friction) return std::nullopt;
  const Measurements& m = input.measurements;
  const Law& law = *FindLaw(friction->law);
  const std::vector<double> values = LawValues(*friction);
  const EstimatedParameter* start = estimate.Find("initial_energy");
  const double energy = start ? start->value : 0;

  FittedModel model;
  model.selection = input.selection;
  model.torque = m.torque;
  if (estimate.gravity) TakeOff(*estimate.gravity, m.position, model);
  const Prediction prediction = PredictFriction(*friction, m, energy, BristleStart::torque);
  model.residual = model.torque - prediction.force;
  model.energy = prediction.energy;
  if (!friction->maps.empty()) model.maps = MapForce(law, values, m, prediction);
  model.derivatives = NominalDerivatives(law, values, m.velocity);
  for (const ParameterInfo& info : law.parameters) model.names.emplace_back(info.name);
  Eigen::MatrixXd by_jumps(m.size(), 0);
  if (friction->thermal && estimate.Find("thermal_gain")) {
    // beside a warming that was estimated, the law's parameters act through the losses too
    const std::vector<LogGap> gaps = FindGaps(m);
    const auto jumps = static_cast<Eigen::Index>(gaps.size());
    const ClosedLoop loop =
        ClosedLoop(m.time, m.velocity, model.derivatives, m.starts).WithJumps(Behind(gaps));
    const auto d = static_cast<Eigen::Index>(values.size());
    const Eigen::Map<const Eigen::VectorXd> parameters(values.data(), d);
    const Eigen::MatrixXd all =
        loop.Jacobian(parameters, *friction->thermal, energy, Eigen::VectorXd::Zero(jumps));
    by_jumps = all.rightCols(jumps);
    if (StepMatters(estimate, m)) model.held_loss = ForceOfHeldLoss(*friction, m, energy);
    model.jump_spread =
        JumpSpread(gaps, model.energy.cwiseAbs().maxCoeff(), friction->thermal->time_constant);
    model.derivatives = all.leftCols(start ? d + 3 : d + 2);
    model.names.insert(model.names.end(), {"thermal_gain", "thermal_time_constant"});
    if (start) model.names.emplace_back("initial_energy");
    if (!start) model.by_initial_energy = all.col(d + 2);
  }
  if (estimate.gravity) AddGravity(*estimate.gravity, m.position, model);
  model.derivatives = Beside(model.derivatives, by_jumps);
  return model;
}

}  // namespace warmjoint::inline identification
