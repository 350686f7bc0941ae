#include "tools/robot/payload.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "identification/model/report_joint.h"
#include "identification/model/shared_directions.h"
#include "identification/uncertainty/tails.h"
#include "tools/robot/at_once.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kShare =
    .2;  // of the mass that moves, and of the reach: what arms are built to carry
constexpr double kHelps = 2.0 / 3;  // of the residual
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

namespace {

/// Mass of the load: what the last link has beyond what the description may have wrong. free: deviations with a free last link
EstimatedParameter MassOf(const RobotData& data, const VectorXd& described, const VectorXd& free,
                          const SharedDirections& shared) {
  const Index at = 10 * LastLink(data.robot);  // the mass of that link
  const double own = described[at] * described[at], all = free[at] * free[at];
  // of two normal parts of one sum: the load's share, and what stays open between both
  const double share = 1 - own / all;
  const double variance = share * share * all * shared.covariance(at, at) + own * share;
  EstimatedParameter mass{.name = "payload",
                          .value = share * free[at] * shared.z[at],
                          .unit = "kg",
                          .std = std::sqrt(variance),
                          .interval95 = {}};
  const double reach = StudentQuantile(shared.degrees_of_freedom, kIntervalLevel) * *mass.std;
  mass.interval95 = {{mass.value - reach, mass.value + reach}};
  return mass;
}

/// A joint with the last link free, and by what its held-out residual falls; nothing where too little is left to hold out.
struct Loaded {
  JointColumns columns;
  JointFit fit;
  std::optional<double> falls;
};

}  // namespace

Payload FindPayload(const RobotData& data, const RobotRows& rows,
                    const std::vector<GainGuess>& guesses, const std::vector<Index>& joints,
                    JointQuestion question) {
  question.warms = question.slows = false;
  const RobotRows as_given = Thinned(data, rows);
  RobotRows free = as_given;
  free.deviations = FreeLastLink(data, rows.deviations);
  std::vector<Loaded> loaded(joints.size());
  ForEachAtOnce(std::ssize(joints), [&](Index i) {
    const auto at = static_cast<std::size_t>(i);
    const Index j = joints[at];
    const GainGuess& guess = guesses[static_cast<std::size_t>(j)];
    const JointColumns given = ColumnsOf(data, as_given, j);
    Loaded& one = loaded[at];
    one.columns = ColumnsOf(data, free, j, Directions::parameters);
    one.fit = FitJoint(one.columns, guess, question);
    const auto before = HoldOutJoint(FitJoint(given, guess, question), given, kHeldOut),
               after = HoldOutJoint(one.fit, one.columns, kHeldOut);
    if (before && after) one.falls = after->metrics.rmse / before->metrics.rmse;
  });

  Payload payload;
  double falls_of_all = 0;  // logarithm
  std::vector<JointFit> fits;
  std::vector<JointColumns> columns;
  for (Loaded& one : loaded) {
    if (one.falls) {
      payload.falls = std::min(payload.falls, *one.falls);
      falls_of_all += std::log(*one.falls);
    }
    fits.push_back(std::move(one.fit));
    columns.push_back(std::move(one.columns));
  }
  payload.is_shown = payload.falls < kHelps && falls_of_all < std::log(kHelps);
  payload.mass = MassOf(data, rows.deviations, free.deviations, FitShared(fits, columns));
  return payload;
}

std::string ExplainPayload(const Payload& payload, ToolKnown tool) {
  const auto& [lower, upper] = *payload.mass.interval95;
  std::string text = fmt::format(
      "the log shows a load at the last link that the description lacks, {:.2g} kg ({:.2g} to "
      "{:.2g}): with that link free a joint's held-out residual falls to {:.0f} %",
      payload.mass.value, lower, upper, 100 * payload.falls);
  if (tool == ToolKnown::unknown) return text;
  return text + ". --tool unknown takes it in, --tool mass=..,com=.. where it is known";
}

}  // namespace warmjoint
