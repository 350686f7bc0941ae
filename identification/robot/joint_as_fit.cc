#include "identification/robot/joint_as_fit.h"

#include <algorithm>
#include <cmath>

#include "identification/fit/fit_data.h"
#include "identification/fit/fit_parameters.h"
#include "identification/robot/explain_robot.h"
#include "identification/uncertainty/tails.h"
#include "models/friction/parameter_rows.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kRounding = 1e-9;  // of a half width
constexpr double kKnownGain =
    1.5;  // why: a torque with an error of a half is known no better than from the data sheet

Unknown ParameterOf(const JointFit& fit, Index row) {
  const Unknown& unknown = fit.model.table[static_cast<std::size_t>(row)];
  // at its bound, but for rounding
  const double value = ValueOf(fit, row),
               at_bound = kRounding * HalfWidthOf(fit, VectorXd::Unit(fit.model.size(), row));
  const bool held = IsNominal(unknown.role) && value - unknown.lower <= at_bound;
  Unknown parameter = WithValue(unknown, held ? unknown.lower : value);
  parameter.has_interval = !unknown.name.empty() && (unknown.role != Role::scale || KnowsGain(fit));
  return parameter;
}

Friction FrictionValue(const JointFit& fit, const JointColumns& c) {
  Friction friction;
  const bool slows = fit.Slows();
  friction.law = slows ? "asymmetric_stribeck" : "asymmetric";
  const Slice law = fit.At(Role::law);
  for (Index row = law.begin; row < law.end(); ++row) {
    friction.parameters[fit.model.table[static_cast<std::size_t>(row)].name] = fit.solved.x[row];
  }
  if (slows) {
    friction.parameters[std::string(kStribeckVelocityRow.name)] = fit.slow_share * c.top_speed;
    friction.parameters[std::string(kStribeckExponentRow.name)] = 2;
  }
  friction.load_gain = fit.solved.x[fit.At(Role::load).begin];
  if (fit.model.heat) friction.thermal = fit.model.heat->At(fit.solved.x);
  return friction;
}

/// E at the last sample, and its derivatives.
EndEnergy EndOf(const JointFit& fit) {
  const HeatState end = ModelAt(fit.model, fit.solved.x).End();
  return {end.energy, end.slopes};
}

}  // namespace

double ValueOf(const JointFit& fit, Index row) {
  return fit.model.table[static_cast<std::size_t>(row)].ValueAt(fit.solved.x[row]);
}

double HalfWidthOf(const JointFit& fit, const VectorXd& weights) {
  const double deviation =
      std::sqrt(std::max(0.0, weights.dot(fit.uncertainty.covariance * weights)));
  return StudentQuantile(fit.uncertainty.degrees_of_freedom, kIntervalLevel) * deviation;
}

bool KnowsGain(const JointFit& fit) {
  return HalfWidthOf(fit, VectorXd::Unit(fit.model.size(), fit.At(Role::scale).begin)) <
         std::log(kKnownGain);
}

LogSamples SamplesOf(const JointFit& fit, const JointColumns& c) {
  LogSamples m;
  m.joint = c.kind;
  m.torque_unit = c.torque_unit;
  m.time = c.samples.time;
  m.velocity = c.velocity;
  m.position = c.position;
  m.torque = c.samples.torque;
  m.further_starts = c.samples.starts;
  const SampleRange all{0, c.samples.time.size()};
  const GivenPlaces given = fit.Given();
  m.load = given.Gain(fit.solved.x) * c.carried.At(all, given.z.Of(fit.solved.x));
  return m;
}

Fit FitOf(const JointFit& fit, const JointColumns& c, const ModelSamples& samples) {
  Fit made;
  made.identifier = "robot";
  made.summary = SummaryOfJoint(fit, c);
  made.model.friction = FrictionValue(fit, c);
  made.rows.used = {samples.keep, {}};
  made.rows.torque = Kept(samples.torque, made.rows.used);
  made.rows.fitted = made.rows.torque - Kept(fit.solved.residual, made.rows.used);
  for (Index row = 0; row < fit.model.size(); ++row) {
    made.parameters.push_back(ParameterOf(fit, row));
  }
  made.rows.count = static_cast<int>(fit.model.size());
  made.rows.effective_parameters = fit.effective_parameters;
  made.rows.jacobian = [&fit] { return ModelAt(fit.model, fit.solved.x).All().derivatives; };
  made.rows.errors.covariance = [uncertainty = fit.uncertainty] { return uncertainty; };
  if (fit.model.heat) made.figures.end_energy = [&fit] { return EndOf(fit); };
  return made;
}

}  // namespace warmjoint
