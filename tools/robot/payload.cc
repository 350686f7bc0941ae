#include "tools/robot/payload.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "identification/fit_data.h"
#include "identification/model/report_joint.h"
#include "identification/uncertainty/tails.h"

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

/// What joints say of u, the relative errors of all inertials: phi = phi0 + D u, u ~ N(0, 1) before the log.
struct Knowledge {
  MatrixXd precision;
  VectorXd information;

  /// Adds what a fit knows of z = V^T u beyond its prior.
  void Add(const JointFit& fit, const MatrixXd& directions) {
    const Slice& z = fit.at.given.z;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(z.Block(fit.known.covariance));
    // what is known no better than before says nothing
    const VectorXd values = solver.eigenvalues().cwiseMax(1e-12).cwiseMin(1.0);
    const MatrixXd axes = directions * solver.eigenvectors();
    const VectorXd beyond = values.cwiseInverse().array() - 1;
    const VectorXd mean = solver.eigenvectors().transpose() * z.Of(fit.solved.x);
    precision += axes * beyond.asDiagonal() * axes.transpose();
    information += axes * (beyond.array() > 0).select(mean.cwiseQuotient(values), 0.0).matrix();
  }
};

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
  const Index size = free.deviations.size();
  Knowledge known{MatrixXd::Identity(size, size), VectorXd::Zero(size)};
  Payload payload;
  bool rises = false;
  double freedom = 1e9;
  for (const Index j : joints) {
    const GainGuess& guess = guesses[static_cast<std::size_t>(j)];
    const JointColumns given = ColumnsOf(data, as_given, j);
    MatrixXd basis;
    const JointColumns loaded = ColumnsOf(data, free, j, &basis);
    const JointFit without = FitJoint(given, guess, question),
                   with = FitJoint(loaded, guess, question);
    known.Add(with, free.deviations.cwiseMax(1e-300).cwiseInverse().asDiagonal() * basis);
    freedom = std::min(freedom, with.known.degrees_of_freedom);
    const auto before = HoldOutJoint(without, given, kHeldOut),
               after = HoldOutJoint(with, loaded, kHeldOut);
    if (!before || !after) continue;
    const double falls = after->metrics.rmse / before->metrics.rmse;
    payload.falls = std::min(payload.falls, falls);
    rises = rises || falls > kHarms;
  }

  const MatrixXd covariance = InverseScaled(known.precision);
  const Index mass = 10 * LastLink(data.robot);
  payload.mass = free.deviations[mass] * covariance.row(mass).dot(known.information);
  const double reach = StudentQuantile(freedom, kIntervalLevel) * free.deviations[mass] *
                       std::sqrt(covariance(mass, mass));
  payload.lower = payload.mass - reach;
  payload.upper = payload.mass + reach;
  // a load that would be lighter than nothing is something else
  payload.is_shown = payload.falls < kHelps && !rises && payload.upper > 0;
  return payload;
}

std::string ExplainPayload(const Payload& payload, bool is_asked) {
  const std::string mass =
      fmt::format("{:.3g} kg ({:.3g} to {:.3g})", payload.mass, payload.lower, payload.upper);
  if (is_asked) return fmt::format("a load of {} at the last link goes with the log", mass);
  return fmt::format(
      "the log shows a load of {} at the last link that the description lacks: with it a joint's "
      "held-out residual falls to {:.0f} %. --tool unknown takes it in, --tool mass=..,com=.. "
      "where it is known",
      mass, 100 * payload.falls);
}

}  // namespace warmjoint
