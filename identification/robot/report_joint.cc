#include "identification/robot/report_joint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "identification/answer/floors.h"
#include "identification/answer/speed_figures.h"
#include "identification/fit/fit_data.h"
#include "identification/fit/fit_parameters.h"
#include "identification/inference/apply.h"
#include "identification/inference/inference.h"
#include "identification/model/normal_equations.h"
#include "identification/report/report_fit.h"
#include "identification/robot/explain_robot.h"
#include "identification/robot/joint_as_fit.h"
#include "identification/robot/joint_fields.h"
#include "identification/uncertainty/tails.h"
#include "models/friction/parameter_rows.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int kFewest = 30;  // why 30: fewer do not show colour and structure of the noise

/// Series over the log for pictures.
JointSeries SeriesOf(const JointFit& fit, const JointColumns& c) {
  // what brakes: law, load and heat
  Model friction = fit.model;
  std::erase_if(friction.blocks, [](const auto& block) { return !block->MakesHeat(); });
  const ModelRows rows = ModelAt(friction, fit.solved.x).All();
  VectorXd fitted = rows.force;
  if (fit.fields) fitted += FrictionOfMaps(fit.fields->fit.model.friction, SamplesOf(fit, c));
  return {.time = c.samples.time,
          .velocity = c.velocity,
          .measured = fitted + fit.solved.residual,
          .fitted = fitted,
          .energy = rows.energy,
          .kept = c.samples.keep};
}

VectorXd MeanCoulomb(const JointFit& fit) {
  VectorXd weights = VectorXd::Zero(fit.model.size());
  const Index law = fit.At(Role::law).begin;
  weights[law + 1] = weights[law + 2] = .5;
  return weights;
}

/// Remarks on the numbers of a joint, and friction that would drive it.
std::vector<Cause> CausesOf(const JointFit& fit, const JointColumns& c, bool gain_is_known) {
  std::vector<Cause> causes;
  if (!fit.beyond.empty()) {
    causes.push_back({.source = Source::own_law,
                      .action = Action::refuse,
                      .status = Status::inadequate_model,
                      .sentence = ExplainBeyond(fit.beyond)});
  }

  // what a reader has to know in addition to the numbers
  const auto say = [&](std::string sentence) {
    causes.push_back(Note(std::move(sentence), SentenceIn::any_answer));
  };
  if (fit.Given().sign < 0) say(ExplainTurnedSign(c.joint));
  if (fit.description_error > 1) say(ExplainWrongDescription(c.joint, fit.description_error));
  if (fit.Has(Role::offset)) {
    const Index row = fit.At(Role::offset).begin;
    const double half = HalfWidthOf(fit, VectorXd::Unit(fit.model.size(), row));
    if (std::abs(fit.Value(row)) > half) {
      say(ExplainOffset(c.joint, fit.Value(row), half, c.torque_unit));
    }
  }
  const Index rotor = fit.At(Role::inertia).begin;
  VectorXd by_rotor = VectorXd::Zero(fit.model.size());
  by_rotor[rotor] = 1;
  if (fit.Value(rotor) + HalfWidthOf(fit, by_rotor) < 0) say(kNegativeRotor);
  if (c.torque_unit == "A" && !gain_is_known) say(ExplainUnknownGain(c.joint));
  if (!fit.solved.converged) say(kStillMoving);
  return causes;
}

/// The friction in N.m or N of one in amperes, seen through a gain.
void ToTorque(double gain, Friction& friction) {
  for (auto& [name, value] : friction.parameters) {
    if (name == kStribeckVelocityRow.name || name == kStribeckExponentRow.name) continue;
    value /= gain;
  }
  for (FrictionMap& map : friction.maps) {
    for (double& weight : map.weights) weight /= gain;
  }
}

/// The mean of both directions, which a log determines better than their difference.
EstimatedParameter MeanRow(const JointFit& fit, const JointColumns& c, bool has_interval) {
  const VectorXd mean = MeanCoulomb(fit);
  const double value = mean.dot(fit.solved.x), reach = HalfWidthOf(fit, mean);
  EstimatedParameter row{std::string(kCoulombRow.name), value, c.torque_unit, {}, {}};
  if (!has_interval) return row;
  row.std = reach / StudentQuantile(fit.uncertainty.degrees_of_freedom, kIntervalLevel);
  row.interval95 = {{value - reach, value + reach}};
  return row;
}

}  // namespace

JointHoldOut HoldOutJoint(const JointFit& fit, const JointColumns& c, double share) {
  JointHoldOut found;
  if (share <= 0) return found;
  const auto cut = SplitOf({c.samples.keep, {}}, share);
  const double needed = kFewest + fit.effective_parameters;
  if (!cut || static_cast<double>(cut->first.count()) < needed || cut->rest.count() < kFewest) {
    found.held.why_none = "too few samples move";
    return found;
  }
  const Selection& rest = cut->rest;
  ModelSamples first = c.samples;
  first.keep = cut->first.keep;
  const VectorXd residual = c.samples.torque - PredictedBy(fit, c, first);
  const VectorXd measured = Kept(c.samples.torque, rest);
  found.held.metrics = ComputeMetrics(measured, measured - Kept(residual, rest),
                                      static_cast<int>(fit.model.size()), fit.effective_parameters);
  found.held.varied = IsVaried(c.velocity, rest);
  Selection moving = rest;
  constexpr double at_rest = .02;  // of the top speed
  moving.keep = c.velocity.array().abs() > at_rest * c.top_speed;
  moving.keep.head(cut->at) = false;
  found.moving = std::sqrt(Kept(residual, moving).array().square().mean());

  // gain and offset alone
  Eigen::MatrixXd columns(c.velocity.size(), 2);
  columns << c.rigid.force, VectorXd::Ones(c.velocity.size());
  const Eigen::MatrixXd known = Kept(columns, cut->first);
  const VectorXd x = SolveScaled(known.transpose() * known,
                                 known.transpose() * Kept(c.samples.torque, cut->first));
  found.held.without_friction =
      std::sqrt((measured - Kept(columns, rest) * x).array().square().mean());
  return found;
}

std::string WhyNothing(const JointColumns& c, double travel) {
  if (travel < kLeastTravel) return ExplainDidNotMove(c.joint, travel, c.kind);
  const auto& keep = c.samples.keep;
  const Index forwards = (keep && c.velocity.array() > 0).count();
  const Index backwards = (keep && c.velocity.array() < 0).count();
  if (forwards + backwards < kFewest)
    return ExplainLittleMotion(c.joint, forwards + backwards, kFewest);
  if (std::min(forwards, backwards) < kFewest / 2) return ExplainOneDirection(c.joint);
  return "";
}

RobotJointEstimate ReportNothing(const JointColumns& c, RobotJointSummary summary, Status status,
                                 std::string message) {
  RobotJointEstimate made{std::move(summary), {}};
  made.summary.joint = c.joint;
  made.estimate.identifier = "robot";
  made.estimate.status = status;
  made.estimate.message = std::move(message);
  return made;
}

RobotJointEstimate ReportJoint(const JointFit& fit, const JointColumns& c,
                               RobotJointSummary summary, const JointHoldOut& holdout) {
  const double gain = ValueOf(fit, fit.At(Role::scale).begin);
  summary.gain = gain;
  if (c.basis.cols() <= fit.At(Role::direction).size && c.described.size() > 0) {
    const VectorXd z = fit.At(Role::direction).Of(fit.solved.x);
    const VectorXd mended = c.described + c.basis * z.head(c.basis.cols());
    summary.inertials.assign(mended.begin(), mended.end());
  }
  summary.gain_is_known = KnowsGain(fit);

  const LogSamples m = SamplesOf(fit, c);

  // judged as any other fit
  const Fit made = fit.fields ? fit.fields->fit : FitOf(fit, c, c.samples);
  Inference by_noise = ByNoise(made);
  std::vector<Cause> causes = OwnCauses(made, by_noise);
  by_noise.at_speeds =
      SpeedFiguresOf(made, Apply(by_noise, causes), std::nullopt, m, made.rows.used);
  std::ranges::move(CausesOf(fit, c, summary.gain_is_known), std::back_inserter(causes));
  const auto judge = [&](const auto& floor) {
    if (IsRefused(causes)) return;
    if (std::optional<Cause> cause = floor()) causes.push_back(*std::move(cause));
  };
  judge([&] { return FloorCause(made, m, by_noise, kDefaultRelevance); });
  judge([&] { return UnknownFriction(by_noise.at_speeds, causes); });
  judge([&] { return FloorOfHeldOut(holdout.held, made); });
  const Inference inference = Apply(std::move(by_noise), std::move(causes));
  RobotJointEstimate answer{std::move(summary), ReportFit(made, inference, m), SeriesOf(fit, c)};
  Estimate& estimate = answer.estimate;
  if (!estimate.parameters.empty()) {
    estimate.parameters.push_back(MeanRow(fit, c, estimate.status == Status::ok));
  }
  estimate.holdout = holdout.held.metrics;
  estimate.without_holdout = holdout.held.why_none;
  if (estimate.holdout) {
    answer.summary.rms_held_out = estimate.holdout->rmse;
    answer.summary.rms_moving = holdout.moving;
    answer.summary.rms_without_friction = holdout.held.without_friction;
  }
  if (estimate.friction && c.torque_unit == "A") {
    if (answer.summary.gain_is_known) {
      ToTorque(std::abs(gain), *estimate.friction);
    } else {
      estimate.friction->torque_unit = "A";
    }
  }
  return answer;
}

}  // namespace warmjoint
