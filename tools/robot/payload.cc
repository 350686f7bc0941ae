#include "tools/robot/payload.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "identification/model/normal_equations.h"
#include "identification/robot/report_joint.h"
#include "identification/robot/shared_directions.h"
#include "identification/uncertainty/tails.h"
#include "tools/robot/at_once.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kShare =
    .2;  // of the mass that moves, and of the reach: what arms are built to carry
constexpr double kHeldGain = .1;    // of its spread, at the start of what all joints say together
constexpr double kHelps = 2.0 / 3;  // of the residual
constexpr double kHeldOut = .4;
constexpr Index kMostRows =
    5000;  // why: inertials are told by the poses, of which a log has far fewer

using LinkMatrix = Eigen::Matrix<double, 10, 10>;

/// Deviations of a load at the last link, about none: a fifth of all that moves, within a fifth of the reach.
InertialParameters LoadSpread(const RobotDescription& robot) {
  double mass = 0, reach = 0;
  for (const RobotLink& link : robot.links) {
    mass += link.parameters[0];
    reach += Eigen::Map<const Eigen::Vector3d>(robot.model->body_pos + 3 * link.body).norm();
  }
  mass *= kShare;
  const double size = std::max(kShare * reach, .05);
  InertialParameters load;
  load << mass, Eigen::Vector3d::Constant(mass * size),
      Eigen::Matrix<double, 6, 1>::Constant(mass * size * size);
  return load;
}

}  // namespace

namespace {

/// How much of a joint's rigid torque its directions leave open, as a share.
double OpenShare(const JointColumns& columns) {
  return columns.rigid.directions.norm() / columns.rigid.force.norm();
}

}  // namespace

LoadedGains GainsUnderLoad(std::vector<GainGuess> guesses,
                           const std::vector<const JointColumns*>& free) {
  LoadedGains loaded{std::move(guesses), 1};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < free.size(); ++j) {
    const GainGuess& guess = loaded.guesses[j];
    const double open = OpenShare(*free[j]);
    if (IsTorque(*free[j]) || !guess.IsSure() || !(open < least)) continue;
    least = open;
    loaded.middle = std::abs(guess.value);
  }
  for (std::size_t j = 0; j < free.size(); ++j) {
    double& value = loaded.guesses[j].value;
    if (!IsTorque(*free[j])) {
      value = std::copysign(loaded.middle, value);
      continue;
    }
    // an axis that is turned against the description is so with any load
    const GainGuess with_any = GuessGain(*free[j], Description::as_prior);
    value = with_any.IsSure() && with_any.value < 0 ? -1 : 1;
  }
  return loaded;
}

MatrixXd FreeLastLink(const RobotData& data, const MatrixXd& deviations) {
  const Index at = 10 * LastLink(data.robot);
  const LinkMatrix own = deviations.block<10, 10>(at, at);
  const InertialParameters load = LoadSpread(data.robot);
  LinkMatrix covariance = own * own.transpose();
  covariance.diagonal() += load.cwiseAbs2();
  MatrixXd free = deviations;
  free.block<10, 10>(at, at) = covariance.llt().matrixL();
  return free;
}

namespace {

/// Mass of the load: what the last link has beyond what the description may have wrong. described, free: [10 L x 10 L] deviations
EstimatedParameter MassOf(const RobotData& data, const MatrixXd& described, const MatrixXd& free,
                          const SharedDirections& shared) {
  const Index at = 10 * LastLink(data.robot);
  const LinkMatrix own = described.block<10, 10>(at, at), all = free.block<10, 10>(at, at);
  // of two normal parts of one sum: the load's mass by that sum, and what stays open between both
  const double prior = std::pow(LoadSpread(data.robot)[0], 2);
  const InertialParameters share =
      prior * InverseScaled(all * all.transpose()).col(0);  // of the link's ten
  const InertialParameters of_z = all.transpose() * share;
  const double open = share.dot(own * own.transpose() * InertialParameters::Unit(0));
  const double variance =
      of_z.dot(shared.covariance.block<10, 10>(at, at) * of_z) + std::max(open, 0.0);
  EstimatedParameter mass{.name = "payload",
                          .value = of_z.dot(shared.z.segment<10>(at)),
                          .unit = "kg",
                          .std = std::sqrt(variance),
                          .interval95 = {}};
  const double reach = StudentQuantile(shared.degrees_of_freedom, kIntervalLevel) * *mass.std;
  mass.interval95 = {{mass.value - reach, mass.value + reach}};
  return mass;
}

/// Rms that a fit to the first part of the log leaves in the rest; nothing where too little is left to hold out.
std::optional<double> LeftAtTheEnd(const JointColumns& columns, const GainGuess& guess,
                                   const JointQuestion& question) {
  const auto found = HoldOutJoint(FitJoint(columns, guess, question), columns, kHeldOut);
  if (!found.held.metrics) return std::nullopt;
  return found.held.metrics->rmse;
}

/// What all joints say together of the description with a free last link.
SharedDirections SharedOf(const RobotData& data, const RobotRows& free,
                          const std::vector<GainGuess>& guesses, const std::vector<Index>& joints,
                          const JointQuestion& question) {
  std::vector<JointFit> fits(joints.size());
  std::vector<JointColumns> columns(joints.size());
  ForEachAtOnce(std::ssize(joints), [&](Index i) {
    const auto at = static_cast<std::size_t>(i);
    columns[at] = ColumnsOf(data, free, joints[at], Directions::all);
    // where the unit tells the gains, all begin with them held, since a gain of each stands for the load as well
    const GainPrior prior = PriorOfGain(columns[at], guesses[at], question.middle_gain);
    JointQuestion held = question;
    if (IsTorque(columns[at])) held.gain_spread = kHeldGain * prior.spread;
    JointFit& fit = fits[at] = FitJoint(columns[at], guesses[at], held);
    const auto gain = static_cast<std::size_t>(fit.At(Role::scale).begin);
    fit.model.table[gain].prior->deviation = prior.spread;
  });
  return FitShared(fits, columns);
}

}  // namespace

Payload FindPayload(const RobotData& data, const RobotRows& rows,
                    const std::vector<GainGuess>& guesses, const std::vector<Index>& joints,
                    JointQuestion question, ToolKnown tool) {
  question.warms = question.slows = false;
  question.fields = {};
  const RobotRows as_given = Thinned(data, rows, kMostRows);
  RobotRows free = as_given;
  free.deviations = FreeLastLink(data, rows.deviations);
  std::vector<JointColumns> columns(joints.size());
  std::vector<GainGuess> own;
  for (const Index j : joints) own.push_back(guesses[static_cast<std::size_t>(j)]);
  ForEachAtOnce(std::ssize(joints), [&](Index i) {
    const auto at = static_cast<std::size_t>(i);
    columns[at] = ColumnsOf(data, free, joints[at]);
  });
  std::vector<const JointColumns*> of_joints;
  for (const JointColumns& one : columns) of_joints.push_back(&one);
  const LoadedGains gains = GainsUnderLoad(own, of_joints);
  JointQuestion under_load = question;
  under_load.middle_gain = gains.middle;
  std::vector<std::optional<double>> falls(joints.size());
  ForEachAtOnce(std::ssize(joints), [&](Index i) {
    const auto at = static_cast<std::size_t>(i);
    // where the unit tells the gain, it cannot stand for the load
    const bool is_told = IsTorque(columns[at]);
    const auto before =
        LeftAtTheEnd(ColumnsOf(data, as_given, joints[at]), is_told ? gains.guesses[at] : own[at],
                     is_told ? under_load : question);
    const auto after = LeftAtTheEnd(columns[at], gains.guesses[at], under_load);
    if (before && after) falls[at] = *after / *before;
  });

  Payload payload;
  double falls_of_all = 0;  // logarithm
  for (const std::optional<double>& one : falls) {
    if (!one) continue;
    payload.falls = std::min(payload.falls, *one);
    falls_of_all += std::log(*one);
  }
  payload.is_shown = payload.falls < kHelps && falls_of_all < std::log(kHelps);
  // the mass needs all directions of all joints at once, which takes as long as everything else
  if (payload.is_shown || tool == ToolKnown::unknown) {
    const SharedDirections shared = SharedOf(data, free, gains.guesses, joints, under_load);
    payload.mass = MassOf(data, rows.deviations, free.deviations, shared);
  }
  // what lifts the robot, or may be nothing, is another error of the description
  payload.is_shown = payload.is_shown && (*payload.mass->interval95)[0] > 0;
  if (!payload.is_shown && tool != ToolKnown::unknown) payload.mass.reset();
  return payload;
}

std::string ExplainPayload(const Payload& payload, ToolKnown tool) {
  const auto& [lower, upper] = *payload.mass->interval95;
  std::string text = fmt::format(
      "the log shows a load at the last link that the description lacks, {:.2g} kg ({:.2g} to "
      "{:.2g}): with that link free a joint's held-out residual falls to {:.0f} %",
      payload.mass->value, lower, upper, 100 * payload.falls);
  if (tool == ToolKnown::unknown) return text;
  return text + ". The fits take it in; --tool mass=..,com=.. says what it is, where that is known";
}

}  // namespace warmjoint
