#include "identification/answer/floors.h"

#include <algorithm>
#include <cmath>

#include "identification/fit/fit_along.h"
#include "identification/fit/fit_data.h"
#include "identification/preparation/moving_view.h"
#include "identification/sentences/friction.h"
#include "identification/sentences/log.h"

namespace warmjoint {
namespace {

constexpr double kFewest = 30;        // why 30: fewer do not show colour and structure of the noise
constexpr double kLeastShare = 0.05;  // why: the rest, 19 times as much, may be another motion
constexpr double kWorse = 10.8;    // why: chi-squared of one degree of freedom, once in a thousand
constexpr double kLeastFit = 20;   // %; why: of 45 answers on real logs only wrong ones are below
constexpr double kMostLeft = 0.5;  // of the friction; why: the same
// of the friction; why: chosen, between good real logs and those on which another joint moves, .6 to 1.5
constexpr double kMostTorqueOverTime = 0.5;
// of the friction, rms; why: as of all findings together (find_lack_of_fit.cc), a friction that changes by more has no one law
constexpr double kMostDrift = 0.25;
constexpr double kNoFriction = 3e-3;  // of the torque; why: gears lose ten times as much at least

double RootMeanSquare(const Eigen::VectorXd& x) {
  return std::sqrt(x.squaredNorm() / static_cast<double>(x.size()));
}

/// Whether any figure is known to be above 0.
bool IsKnown(const std::vector<SpeedFigure>& at_speeds) {
  return std::ranges::any_of(at_speeds,
                             [](const SpeedFigure& one) { return one.at.interval95[0] > 0; });
}

Cause Floor(Source source, Status status, std::string sentence) {
  return {.source = source,
          .action = Action::refuse,
          .status = status,
          .sentence = std::move(sentence)};
}

}  // namespace

bool LeavesTooMuch(double left, double friction, double others) {
  return friction >= others && left > kMostLeft * friction;
}

std::optional<Cause> FloorCause(const Fit& fit, const LogSamples& m, const Inference& by_noise,
                                double relevance) {
  const auto used = static_cast<double>(fit.rows.torque.size());
  const auto moving = static_cast<double>((m.velocity.array().abs() > ClearSpeed(m)).count());
  if (used < kFewest || used < kLeastShare * moving) {
    MotionKind motion = m.acceleration ? MotionKind::any : MotionKind::constant;
    if (fit.RowOf(Role::scale)) motion = MotionKind::chosen;
    return Floor(Source::few_samples, Status::not_identifiable,
                 ExplainFewSamples(used, moving, kFewest, kLeastShare, motion));
  }
  const Eigen::VectorXd along = Kept(FrictionAlong(fit, m).force, fit.rows.used);
  const double friction = RootMeanSquare(along);
  const double share = friction / RootMeanSquare(fit.rows.torque);
  if (share < kNoFriction) {
    return Floor(Source::no_friction, Status::inadequate_model, ExplainNoFriction(share));
  }
  if (fit.figures.fields && fit.figures.fields->time_torque > kMostTorqueOverTime) {
    return Floor(Source::impossible, Status::inadequate_model,
                 ExplainTorqueOverTime(fit.figures.fields->time_torque));
  }
  if (fit.figures.fields && fit.figures.fields->time_friction > kMostDrift) {
    return Floor(Source::impossible, Status::inadequate_model,
                 ExplainDriftOfFriction(fit.figures.fields->time_friction, kMostDrift));
  }
  // an inertia below 0 that was taken out, without which the friction is another
  const auto inertia = std::ranges::find(fit.causes, Source::findings, &Cause::source);
  if (inertia != fit.causes.end() && inertia->size > relevance * friction) {
    return Floor(Source::impossible, Status::inadequate_model,
                 ExplainInertiaMatters(
                     inertia->sentence, relevance,
                     IsKnown(by_noise.at_speeds) ? TorqueSign::known : TorqueSign::doubtful));
  }

  // how much of the torque is explained, and how large the residual is relative to the friction
  const double left = fit.rows.residual().squaredNorm();
  const double by_mean = (fit.rows.torque.array() - fit.rows.torque.mean()).square().sum();
  const double explained = 100 * (1 - std::sqrt(left / by_mean));
  if (left - by_mean > kWorse * by_noise.uncertainty.noise.variance_inflation * left / used) {
    return Floor(Source::worse_than_mean, Status::inadequate_model,
                 ExplainWorseThanMean(explained, fit));
  }
  const Eigen::VectorXd velocity = Kept(m.velocity, fit.rows.used);
  const bool both = velocity.minCoeff() < 0 && velocity.maxCoeff() > 0;
  if (both && explained < kLeastFit) {
    return Floor(Source::worse_than_mean, Status::inadequate_model,
                 ExplainPoorFit(explained, kLeastFit, fit));
  }
  const double beside = std::sqrt(left / used);
  if (!LeavesTooMuch(beside, friction, RootMeanSquare(fit.rows.fitted - along)))
    return std::nullopt;
  return Floor(Source::worse_than_mean, Status::inadequate_model,
               ExplainMuchLeft(beside, friction, fit));
}

std::optional<Cause> FloorOfHeldOut(const HeldOut& held_out, const Fit& fit) {
  if (!held_out.metrics || !held_out.varied || held_out.metrics->n < kFewest) return std::nullopt;
  const double left = held_out.metrics->rmse;
  if (!(left > held_out.without_friction)) return std::nullopt;
  return Floor(Source::worse_than_mean, Status::inadequate_model,
               ExplainWorseHeldOut(left, held_out.without_friction, fit));
}

}  // namespace warmjoint
