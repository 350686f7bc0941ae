#include "tools/robot/payload.h"

#include <fmt/format.h>

#include <algorithm>

#include "identification/model/report_joint.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kShare =
    .2;  // of the mass that moves, and of the reach: what arms are built to carry
constexpr double kHelps = 2.0 / 3;  // of the residual
constexpr double kHarms = 1.1;
constexpr double kHeldOut = .4;
constexpr Index kMostRows =
    5000;  // why: inertials are told by the poses, of which a log has far fewer

/// Every so manieth sample, for fits without heat.
RobotRows Thinned(const RobotData& data, const RobotRows& rows) {
  RobotRows thinned;
  thinned.parameters = rows.parameters;
  thinned.deviations = rows.deviations;
  for (const RobotSamples& s : rows.samples) {
    const Index every = std::max<Index>(1, s.time.size() / kMostRows);
    const auto thin = Eigen::seq(0, s.time.size() - 1, every);
    RobotSamples t;
    t.step = s.step * static_cast<double>(every);
    t.time = s.time(thin);
    for (const auto column :
         {&RobotSamples::joint_position, &RobotSamples::joint_velocity,
          &RobotSamples::joint_acceleration, &RobotSamples::position, &RobotSamples::velocity,
          &RobotSamples::acceleration, &RobotSamples::torque, &RobotSamples::sign,
          &RobotSamples::forwards, &RobotSamples::backwards, &RobotSamples::slow}) {
      t.*column = (s.*column)(thin, Eigen::all);
    }
    t.keep = s.keep(thin, Eigen::all);
    t.top = s.top;
    t.travel = s.travel;
    t.ripple.assign(s.ripple.size(), MatrixXd(t.time.size(), 0));
    thinned.motions.emplace_back(data.robot, t.joint_position, t.joint_velocity,
                                 t.joint_acceleration);
    thinned.samples.push_back(std::move(t));
  }
  return thinned;
}

}  // namespace

VectorXd FreeLastLink(const RobotData& data, const VectorXd& deviations) {
  const RobotDescription& robot = data.robot;
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
  VectorXd free = deviations;
  const Index at = 10 * LastLink(robot);
  free.segment<10>(at) = (free.segment<10>(at).cwiseAbs2() + load.cwiseAbs2()).cwiseSqrt();
  return free;
}

Payload FindPayload(const RobotData& data, const RobotRows& rows,
                    const std::vector<GainGuess>& guesses, const std::vector<Index>& joints,
                    JointQuestion question) {
  question.warms = question.slows = false;
  const RobotRows as_given = Thinned(data, rows);
  RobotRows free = as_given;
  free.deviations = FreeLastLink(data, rows.deviations);
  Payload payload;
  bool rises = false;
  for (const Index j : joints) {
    const GainGuess& guess = guesses[static_cast<std::size_t>(j)];
    const JointColumns given = ColumnsOf(data, as_given, j);
    const JointColumns loaded = ColumnsOf(data, free, j);
    const JointFit without = FitJoint(given, guess, question),
                   with = FitJoint(loaded, guess, question);
    const auto before = HoldOutJoint(without, given, kHeldOut),
               after = HoldOutJoint(with, loaded, kHeldOut);
    if (!before || !after) continue;
    const double falls = after->metrics.rmse / before->metrics.rmse;
    payload.falls = std::min(payload.falls, falls);
    rises = rises || falls > kHarms;
  }

  payload.is_shown = payload.falls < kHelps && !rises;
  return payload;
}

std::string ExplainPayload(const Payload& payload) {
  return fmt::format(
      "the log shows a load at the last link that the description lacks: with that link free a "
      "joint's held-out residual falls to {:.0f} %. --tool unknown takes it in, --tool "
      "mass=..,com=.. "
      "where it is known",
      100 * payload.falls);
}

}  // namespace warmjoint
