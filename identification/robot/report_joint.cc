#include "identification/robot/report_joint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "identification/answer/speed_figures.h"
#include "identification/fit_data.h"
#include "identification/fit_parameters.h"
#include "identification/inference/apply.h"
#include "identification/inference/inference.h"
#include "identification/model/normal_equations.h"
#include "identification/report/report_fit.h"
#include "identification/robot/explain_robot.h"
#include "identification/uncertainty/tails.h"
#include "models/friction/parameter_rows.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int kFewest = 30;  // why 30: fewer do not show colour and structure of the noise
/// The largest residual as a share of the friction. Why: beyond it the log's torque is not that of the model.
constexpr double kLargestResidual = .5;
constexpr double kRounding = 1e-9;  // of a half width
constexpr double kKnownGain =
    1.5;  // why: a torque with an error of a half is known no better than from the data sheet

/// The value of a row of the table, in the row's unit.
double ValueOf(const JointFit& fit, Index row) {
  const Unknown& unknown = fit.model.table[static_cast<std::size_t>(row)];
  const double x = fit.solved.x[row];
  if (unknown.coordinate != Coordinate::logarithm) return x;
  return (row == fit.at.given.log_gain ? fit.at.given.sign : 1) * std::exp(x);
}

/// Half width of an interval that noise gives a combination of rows.
double HalfWidthOf(const JointFit& fit, const VectorXd& weights) {
  const double deviation =
      std::sqrt(std::max(0.0, weights.dot(fit.uncertainty.covariance * weights)));
  return StudentQuantile(fit.uncertainty.degrees_of_freedom, kIntervalLevel) * deviation;
}

/// Whether the log determines the gain. Where it does not, the value is that of the other joints, and the curvature of the fit
/// says little of how large its error may be.
bool KnowsGain(const JointFit& fit) {
  return HalfWidthOf(fit, VectorXd::Unit(fit.model.size(), fit.at.given.log_gain)) <
         std::log(kKnownGain);
}

FitParameter ParameterOf(const JointFit& fit, Index row) {
  const Unknown& unknown = fit.model.table[static_cast<std::size_t>(row)];
  // at its bound, but for rounding
  const double value = ValueOf(fit, row),
               at_bound = kRounding * HalfWidthOf(fit, VectorXd::Unit(fit.model.size(), row));
  const bool held = IsNominal(unknown.role) && value - unknown.lower <= at_bound;
  FitParameter parameter = WithValue(unknown, held ? unknown.lower : value);
  parameter.has_interval =
      !unknown.name.empty() && (row != fit.at.given.log_gain || KnowsGain(fit));
  return parameter;
}

/// Series over the log for pictures.
JointSeries SeriesOf(const JointFit& fit, const JointColumns& c) {
  // what brakes: law, load and heat
  Model friction = fit.model;
  std::erase_if(friction.blocks, [](const auto& block) { return !block->MakesHeat(); });
  const ModelRows rows = ModelAt(friction, fit.solved.x).All();
  return {.time = c.samples.time,
          .velocity = c.velocity,
          .measured = rows.force + fit.solved.residual,
          .fitted = rows.force,
          .energy = rows.energy,
          .kept = c.samples.keep};
}

Friction FrictionValue(const JointFit& fit, const JointColumns& c) {
  Friction friction;
  const bool slows = fit.at.law.size == 4;
  friction.law = slows ? "asymmetric_stribeck" : "asymmetric";
  for (Index row = fit.at.law.begin; row < fit.at.law.end(); ++row) {
    friction.parameters[fit.model.table[static_cast<std::size_t>(row)].name] = fit.solved.x[row];
  }
  if (slows) {
    friction.parameters[std::string(kStribeckVelocityRow.name)] = kSlowShare * c.top_speed;
    friction.parameters[std::string(kStribeckExponentRow.name)] = 2;
  }
  friction.load_gain = fit.solved.x[fit.at.load.begin];
  if (fit.at.heat) {
    friction.thermal =
        Thermal{fit.solved.x[fit.at.heat->begin], std::exp(fit.solved.x[fit.at.heat->begin + 1])};
  }
  return friction;
}

/// E at the last sample, and its derivatives.
EndEnergy EndOf(const JointFit& fit) {
  const HeatState end = ModelAt(fit.model, fit.solved.x).End();
  return {end.energy, end.slopes};
}

/// The fit in the form that judgements and reports read.
Fit FitOf(const JointFit& fit, const JointColumns& c) {
  Fit made;
  made.identifier = "robot";
  made.summary = SummaryOfJoint(fit, c);
  made.friction = FrictionValue(fit, c);
  made.used = {c.samples.keep, {}};
  made.torque = Kept(c.samples.torque, made.used);
  made.fitted = made.torque - Kept(fit.solved.residual, made.used);
  for (Index row = 0; row < fit.model.size(); ++row) {
    made.parameters.push_back(ParameterOf(fit, row));
  }
  made.count = static_cast<int>(fit.model.size());
  made.effective_parameters = fit.effective_parameters;
  made.errors.covariance = [uncertainty = fit.uncertainty] { return uncertainty; };
  if (fit.at.heat) made.end_energy = [&fit] { return EndOf(fit); };
  return made;
}

VectorXd MeanCoulomb(const JointFit& fit) {
  VectorXd weights = VectorXd::Zero(fit.model.size());
  weights[fit.at.law.begin + 1] = weights[fit.at.law.begin + 2] = .5;
  return weights;
}

/// The causes that make the numbers of a joint mean nothing, and remarks on them.
std::vector<Cause> CausesOf(const JointFit& fit, const JointColumns& c, const JointSeries& series,
                            const std::optional<JointHoldOut>& holdout, bool gain_is_known) {
  std::vector<Cause> causes;
  const Selection used{c.samples.keep, {}};
  const auto refuse = [&](Status status, std::string sentence) {
    causes.push_back({.source = Source::own_law,
                      .action = Action::refuse,
                      .status = status,
                      .sentence = std::move(sentence)});
  };
  if (!fit.beyond.empty()) refuse(Status::inadequate_model, ExplainBeyond(fit.beyond));

  // friction whose error exceeds itself, or that is smaller than the residual
  const VectorXd mean = MeanCoulomb(fit);
  const double level = mean.dot(fit.solved.x), reach = HalfWidthOf(fit, mean);
  const double friction = std::sqrt(Kept(series.fitted, used).array().square().mean());
  const double left = std::sqrt(fit.solved.noise.variance);
  if (reach > std::max(level, friction)) {
    refuse(Status::not_identifiable, ExplainUntold(level, reach, c.torque_unit));
  } else if (left > kLargestResidual * friction) {
    refuse(Status::inadequate_model, ExplainResidual(left, friction, c.torque_unit));
  }
  if (holdout && holdout->metrics.rmse > holdout->without_friction) {
    refuse(Status::inadequate_model,
           ExplainWorseHeldOut(holdout->metrics.rmse, holdout->without_friction, c.torque_unit));
  }

  // what a reader has to know in addition to the numbers
  const auto say = [&](std::string sentence) {
    causes.push_back(Note(std::move(sentence), SentenceIn::any_answer));
  };
  if (fit.at.given.sign < 0) say(ExplainTurnedSign(c.joint));
  if (fit.description_error > 1) say(ExplainWrongDescription(c.joint, fit.description_error));
  const Index rotor = fit.at.rotor.begin;
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

std::optional<JointHoldOut> HoldOutJoint(const JointFit& fit, const JointColumns& c, double share) {
  if (share <= 0) return std::nullopt;
  const Index n = c.velocity.size(), cut = n - static_cast<Index>(share * static_cast<double>(n));
  ModelSamples train = c.samples;
  train.keep.tail(n - cut) = false;
  Selection test{c.samples.keep, {}};
  test.keep.head(cut) = false;
  if (static_cast<double>(train.keep.count()) < kFewest + fit.effective_parameters ||
      test.count() < kFewest) {
    return std::nullopt;
  }
  const SolvedModel again = FitAgain(fit, c, train);
  JointHoldOut found;
  const VectorXd measured = Kept(c.samples.torque, test);
  found.metrics = ComputeMetrics(measured, measured - Kept(again.residual, test),
                                 static_cast<int>(fit.model.size()), fit.effective_parameters);
  Selection moving = test;
  constexpr double at_rest = .02;  // of the top speed
  moving.keep = c.velocity.array().abs() > at_rest * c.top_speed;
  moving.keep.head(cut) = false;
  found.moving = std::sqrt(Kept(again.residual, moving).array().square().mean());

  // gain and offset alone
  Eigen::MatrixXd columns(n, 2);
  columns << c.rigid.force, VectorXd::Ones(n);
  const Eigen::MatrixXd seen = Kept(columns, {train.keep, {}});
  const VectorXd x = SolveScaled(seen.transpose() * seen,
                                 seen.transpose() * Kept(c.samples.torque, {train.keep, {}}));
  found.without_friction = std::sqrt((measured - Kept(columns, test) * x).array().square().mean());
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
                               RobotJointSummary summary,
                               const std::optional<JointHoldOut>& holdout) {
  const double gain = ValueOf(fit, fit.at.given.log_gain);
  summary.gain = gain;
  if (c.basis.cols() == fit.at.given.z.size && c.described.size() > 0) {
    const VectorXd mended = c.described + c.basis * fit.at.given.z.Of(fit.solved.x);
    summary.inertials.assign(mended.begin(), mended.end());
  }
  summary.gain_is_known = KnowsGain(fit);

  LogSamples m;
  m.joint = c.kind;
  m.torque_unit = c.torque_unit;
  m.time = c.samples.time;
  m.velocity = c.velocity;
  m.position = c.position;
  m.torque = c.samples.torque;
  const SampleRange all{0, c.samples.time.size()};
  m.load = fit.at.given.Gain(fit.solved.x) * c.carried.At(all, fit.at.given.z.Of(fit.solved.x));

  // judged as any other fit
  const Fit made = FitOf(fit, c);
  JointSeries series = SeriesOf(fit, c);
  Inference by_noise = ByNoise(made);
  std::vector<Cause> causes = OwnCauses(made, by_noise);
  by_noise.at_speeds = SpeedFiguresOf(made, Apply(by_noise, causes), std::nullopt, m, made.used);
  std::ranges::move(CausesOf(fit, c, series, holdout, summary.gain_is_known),
                    std::back_inserter(causes));
  if (auto floor = UnknownFriction(by_noise.at_speeds, causes)) causes.push_back(std::move(*floor));
  const Inference inference = Apply(std::move(by_noise), std::move(causes));
  RobotJointEstimate answer{std::move(summary), ReportFit(made, inference, m), std::move(series)};
  Estimate& estimate = answer.estimate;
  if (!estimate.parameters.empty()) {
    estimate.parameters.push_back(MeanRow(fit, c, estimate.status == Status::ok));
  }
  if (holdout) {
    estimate.holdout = holdout->metrics;
    answer.summary.rms_held_out = holdout->metrics.rmse;
    answer.summary.rms_moving = holdout->moving;
    answer.summary.rms_without_friction = holdout->without_friction;
  } else {
    estimate.without_holdout = "too few samples move";
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
