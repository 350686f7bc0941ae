#include "identification/robot/joint_fields.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "identification/fields/field_rows.h"
#include "identification/fields/fields_about.h"
#include "identification/fit/fit_data.h"
#include "identification/forward/log_trajectory.h"
#include "identification/robot/joint_as_fit.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// The torque of maps alone, of those that `takes` chooses. [N]
template <class Takes>
VectorXd OfMaps(Friction friction, const LogSamples& m, const Takes& takes) {
  std::erase_if(friction.maps, [&](const FrictionMap& map) { return !takes(map); });
  if (friction.maps.empty()) return VectorXd::Zero(m.size());
  friction.thermal = std::nullopt;
  Friction law = friction;
  law.maps.clear();
  return PredictFriction(friction, m).force - PredictFriction(law, m).force;
}

/// The torque of a table with its maps. x: [P]; returns [N] N.m or N
VectorXd TorqueOf(const Model& model, const VectorXd& x, const Friction& friction,
                  const LogSamples& m) {
  VectorXd force(m.size());
  Index n = 0;
  ModelAt(model, x).ForEachStretch([&](const ModelRows& rows) {
    force.segment(n, rows.force.size()) = rows.force;
    n += rows.force.size();
  });
  return force + OfMaps(friction, m, [](const FrictionMap&) { return true; });
}

/// A joint's fit as fields are fitted about it.
FitForFields ForFields(const JointFit& fit, const JointColumns& c, const ModelSamples& samples) {
  const auto kept = std::make_shared<const JointFit>(fit);
  FitForFields at{.fit = FitOf(*kept, c, samples), .motion = SamplesOf(*kept, c)};
  at.fit.rows.jacobian = [kept] { return ModelAt(kept->model, kept->solved.x).All().derivatives; };
  at.torque_of = [kept](const Fit& of, const LogSamples& m) {
    return TorqueOf(kept->model, UnknownsOf(of), of.model.friction, m);
  };
  at.prior_mean = kept->model.PriorMean();
  at.prior_precision = kept->model.PriorPrecision();
  return at;
}

/// The fit to some samples, with fields.
Fit WithFields(const JointFit& fit, const JointColumns& c, const ModelSamples& samples,
               const FieldSet& fields) {
  const auto again = [&](const VectorXd& held) -> std::optional<FitForFields> {
    ModelSamples less = samples;
    less.torque -= held;
    JointFit next = fit;
    next.solved = Solve(next.model, less, fit.solved.x);
    return ForFields(next, c, less);
  };
  Fit made = WithFieldsAbout(ForFields(fit, c, samples), fields, again);
  made.model.inertia.reset();  // the rotor's, a row of the table
  return made;
}

}  // namespace

void AddFields(const JointColumns& c, const FieldSet& fields, JointFit& fit) {
  if (fields.kinds.empty()) return;
  Fit made = WithFields(fit, c, c.samples, fields);
  if (!made.figures.fields) return;
  const VectorXd torque =
      TorqueOf(fit.model, UnknownsOf(made), made.model.friction, SamplesOf(fit, c)) +
      made.rows.rest;
  fit.uncertainty = made.rows.errors.covariance();
  fit.effective_parameters = made.rows.effective_parameters;
  fit.solved.x = UnknownsOf(made);
  fit.solved.noise = NoiseScaleOf(made.rows.residual());
  fit.solved.residual = c.samples.torque - torque;
  made.parameters[static_cast<std::size_t>(fit.At(Role::scale).begin)].has_interval =
      KnowsGain(fit);
  fit.fields = std::make_shared<const FieldsOfJoint>(FieldsOfJoint{fields, std::move(made)});
}

VectorXd PredictedBy(const JointFit& fit, const JointColumns& c, const ModelSamples& samples) {
  JointFit again = fit;
  again.solved = Solve(fit.model, samples, fit.solved.x);
  const VectorXd table = samples.torque - again.solved.residual;
  if (!fit.fields) return table;
  const Fit made = WithFields(again, c, samples, fit.fields->asked);
  if (!made.figures.fields) return table;
  return TorqueOf(fit.model, UnknownsOf(made), made.model.friction, SamplesOf(again, c));
}

VectorXd FrictionOfMaps(const Friction& friction, const LogSamples& m) {
  return OfMaps(friction, m, [](const FrictionMap& map) { return map.factor != MapFactor::one; });
}

}  // namespace warmjoint
