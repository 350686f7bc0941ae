#include "tools/design/possible_joint.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "identification/linear/linear_laws.h"
#include "identification/model/normal_equations.h"
#include "identification/warming/thermal_fit.h"
#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/names.h"
#include "scenarios/scenario.h"
#include "scenarios/yaml.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// why: nothing is known of a parameter beyond a factor of ten; keeps what a motion does not show finite
constexpr double kKnown = 0.01;

constexpr Index kCurve = 7;  // why: as many as the speeds that a search has
// s at a speed; why: about a stroke, which shows a curve that is larger than its own error
constexpr double kShowsCurve = 10;

constexpr int kDrawn = 64;  // why: of which a handful is kept; more change their spread by little

/// Broad ranges about a fifth of the torque: at the fastest speed friction falls by a quarter to two thirds, within minutes to half an hour, as in the gears
/// that were measured (models/library).
DrawnFriction BroadPrior(const MotionLimits& limits) {
  constexpr double fastest_adds = 0.5;
  // why: gears lose a tenth to a third of the effort that their motors are made for; without one any level gives the same motion
  const double level = limits.torque ? *limits.torque / 5 : 10;
  constexpr double least_gain = -0.3, most_gain = -2, shortest = 200, longest = 1800;
  const double fastest = limits.velocity[1];
  DrawnFriction prior;
  prior.friction.law = "viscous_coulomb";
  prior.friction.parameters = {{"viscous", fastest_adds * level / fastest}, {"coulomb", level}};
  const auto range = [&prior](const char* name, double a, double b) {
    prior.draws.numbers[std::string("friction.thermal.") + name] = {Distribution::Kind::log_uniform,
                                                                    a, b};
    return std::copysign(std::sqrt(a * b), a);
  };
  Thermal thermal;
  thermal.gain = range("thermal_gain", most_gain / fastest, least_gain / fastest);
  thermal.time_constant = range("thermal_time_constant", shortest, longest);
  prior.friction.thermal = thermal;
  return prior;
}

/// Logarithms of the sizes of a friction's parameters, by which draws are compared.
VectorXd Coordinates(const Friction& friction) {
  std::vector<double> values;
  const auto add = [&](double value) {
    values.push_back(std::log(std::max(std::abs(value), 1e-12)));
  };
  for (const auto& [name, value] : friction.parameters) add(value);
  if (friction.thermal) {
    add(friction.thermal->gain);
    add(friction.thermal->time_constant);
  }
  return VectorXd::Map(values.data(), std::ssize(values));
}

}  // namespace

DrawnFriction PriorOf(const DesignSettings& settings) {
  DrawnFriction prior;
  if (settings.prior.empty()) {
    prior = BroadPrior(settings.limits);
  } else {
    const Node node = ParseYaml(ReadWholeFile(settings.prior, kLargestDocument), settings.prior);
    // an estimate with what it leaves open, or a friction
    const bool is_estimate = node.Find("status").has_value();
    Tree known = node.tree();
    if (is_estimate) {
      known = {{"estimate", std::filesystem::absolute(settings.prior).string()}};
      if (node.Find("covariance")) known["draw"] = "posterior";
    } else if (const auto friction = node.Find("friction")) {
      known = friction->tree();
    }
    ReadValue(node.With(known), &prior, {});
  }
  const Law* const law = FindLaw(prior.friction.law);
  if (!IsLinear(*law)) {
    Refuse({settings.prior},
           "design knows the derivatives of laws that are linear in their parameters, and {} is "
           "none; give the same friction as viscous_coulomb",
           law->name);
  }
  return prior;
}

std::vector<Friction> Representatives(const DrawnFriction& prior, std::uint64_t seed, int count) {
  std::vector<Friction> chosen{prior.friction};
  if (prior.draws.empty()) return chosen;
  Scenario scenario;
  scenario.name = "prior";
  scenario.friction = prior.friction;
  scenario.draws = prior.draws;
  scenario.seed = seed;
  std::vector<Friction> drawn;
  for (std::uint64_t i = 0; i < kDrawn; ++i) drawn.push_back(Realize(scenario, i).friction);

  // in units of each coordinate's spread
  MatrixXd places(std::ssize(drawn), Coordinates(prior.friction).size());
  for (Index i = 0; i < places.rows(); ++i) {
    places.row(i) = Coordinates(drawn[static_cast<size_t>(i)]) - Coordinates(prior.friction);
  }
  for (Index j = 0; j < places.cols(); ++j) {
    const double spread = places.col(j).norm();
    if (spread > 0) places.col(j) /= spread;
  }
  // the farthest from those that are chosen, again and again
  VectorXd distance = places.rowwise().norm();
  while (std::ssize(chosen) < count) {
    Index farthest = 0;
    if (!(distance.maxCoeff(&farthest) > 0)) break;
    chosen.push_back(drawn[static_cast<size_t>(farthest)]);
    const VectorXd to_it =
        (places.rowwise() - Eigen::RowVectorXd(places.row(farthest))).rowwise().norm();
    distance = distance.cwiseMin(to_it);
  }
  return chosen;
}

PossibleJoint::PossibleJoint(Friction friction, StartBelief start, double noise, double rate,
                             std::optional<std::array<double, 2>> curve)
    : friction_(std::move(friction)), start_(start), noise_(noise), rate_(rate) {
  const Law& law = *FindLaw(friction_.law);
  std::vector<double> values;
  for (const ParameterInfo& parameter : law.parameters) {
    names_.emplace_back(parameter.name);
    values.push_back(friction_.parameters.at(std::string(parameter.name)));
  }
  values_ = VectorXd::Map(values.data(), std::ssize(values));
  const double level = values_.cwiseAbs().maxCoeff();
  if (friction_.thermal) {
    for (const ParameterInfo& parameter : Thermal::parameters) names_.emplace_back(parameter.name);
    values.insert(values.end(), {friction_.thermal->gain, friction_.thermal->time_constant});
  }
  const auto p = static_cast<Index>(names_.size());
  if (curve) {
    curve_.at = VectorXd::LinSpaced(kCurve, std::sqrt((*curve)[0]), std::sqrt((*curve)[1]));
  }
  values.insert(values.end(), static_cast<size_t>(curve_.size()),
                noise / std::sqrt(rate * kShowsCurve));
  if (friction_.thermal) values.push_back(level);
  scales_ = VectorXd::Map(values.data(), std::ssize(values));
  for (double& scale : scales_) {
    if (scale == 0) scale = level > 0 ? level : 1;
  }
  // in units of the size that a curve has
  known_ = MatrixXd::Zero(p + curve_.size(), p + curve_.size());
  known_.diagonal().tail(curve_.size()).setOnes();
}

PossibleJoint::Samples PossibleJoint::SamplesOf(const MotionCells& cells) const {
  const Law& law = *FindLaw(friction_.law);
  LogSamples motion;
  motion.time = cells.time;
  motion.velocity = cells.velocity;
  motion.mean_speed = cells.mean_speed;
  motion.loss_velocity = cells.loss_velocity;
  const MatrixXd columns = LawColumns(law, cells.velocity);
  const auto p = static_cast<Index>(names_.size());
  Samples samples{MatrixXd(cells.time.size(), scales_.size()), cells.held};
  samples.rows.leftCols(columns.cols()) = columns;
  if (curve_.size() > 0) {
    // what does not move is at no speed
    const VectorXd speed = cells.velocity.cwiseAbs().cwiseMax(curve_.at[0] * curve_.at[0]);
    samples.rows.middleCols(p, curve_.size()) =
        cells.velocity.cwiseSign().asDiagonal() * MatrixXd(curve_.Columns(speed.cwiseSqrt()));
  }
  if (friction_.thermal) {
    const LawBlocks blocks(motion, columns, LossColumns(law, motion),
                           MatrixXd(cells.time.size(), 0));
    const MatrixXd warm = WarmJacobian(blocks, values_, *friction_.thermal, 0);
    samples.rows.leftCols(p) = warm.leftCols(p);
    samples.rows.rightCols(1) = warm.rightCols(1);
    // a joint so warm that it would move by itself is none
    const VectorXd energy = blocks.loop->Simulate(values_, *friction_.thermal).energy;
    const double level =
        std::min(law.holding_level(1, values_.data()), law.holding_level(-1, values_.data()));
    const auto beyond = std::ranges::find_if(energy, [=](double e) { return level + e < 0; });
    samples.seconds.tail(energy.end() - beyond).setZero();
  }
  samples.rows *= scales_.asDiagonal();
  return samples;
}

MatrixXd PossibleJoint::Information(const MotionCells& cells) const {
  const Index n = known_.rows();
  // cells count as often as they hold samples
  const Samples samples = SamplesOf(cells);
  const VectorXd weights = (rate_ * samples.seconds).cwiseSqrt() / noise_;
  const MatrixXd all = GramOf(weights.asDiagonal() * samples.rows);
  MatrixXd information = all.topLeftCorner(n, n);
  if (friction_.thermal && start_ == StartBelief::estimated && all(n, n) > 0) {
    information -= all.col(n).head(n) * all.row(n).head(n) / all(n, n);
  }
  return information + known_;
}

MatrixXd PossibleJoint::MeanSquare(const MotionCells& cells) const {
  const Samples samples = SamplesOf(cells);
  MatrixXd rows = samples.rows.leftCols(known_.rows());
  const VectorXd weights = samples.seconds.cwiseSqrt();
  const double seconds = std::max(samples.seconds.sum(), std::numeric_limits<double>::min());
  const MatrixXd warm = GramOf(weights.asDiagonal() * rows);
  // without heat
  rows.leftCols(values_.size()) = LawColumns(*FindLaw(friction_.law), cells.velocity) *
                                  scales_.head(values_.size()).asDiagonal();
  if (friction_.thermal) rows.middleCols(values_.size(), 2).setZero();
  return (warm + GramOf(weights.asDiagonal() * rows)) / (2 * seconds);
}

AimCost::AimCost(const DesignAim& aim, const PossibleJoint& joint, const MotionCells& usual)
    : kind_(aim.kind), parameters_(std::ssize(joint.names())) {
  if (kind_ == AimKind::friction) mean_square_ = joint.MeanSquare(usual);
  if (kind_ != AimKind::parameter) return;
  const auto& names = joint.names();
  const auto found = std::ranges::find(names, aim.parameter);
  if (found == names.end()) {
    Refuse({"--for"},
           "the friction that is expected has no parameter '{}'{}; it has D, friction, {}",
           Excerpt(aim.parameter), Suggestion(aim.parameter, names), fmt::join(names, ", "));
  }
  parameter_ = found - names.begin();
}

double AimCost::operator()(const MatrixXd& information) const {
  const Index p = kind_ == AimKind::friction ? information.rows() : parameters_;
  const MatrixXd known = information.topLeftCorner(p, p) + kKnown * MatrixXd::Identity(p, p);
  const Eigen::LLT<MatrixXd> factor(known);
  switch (kind_) {
    case AimKind::everything:
      return -factor.matrixLLT().diagonal().array().log().sum() / static_cast<double>(p);
    case AimKind::friction:
      return std::log(factor.solve(mean_square_).trace()) / 2;
    case AimKind::parameter:
      return std::log(factor.solve(VectorXd::Unit(p, parameter_))[parameter_]) / 2;
  }
  return 0;
}

VectorXd Deviations(const PossibleJoint& joint, const MotionCells& cells) {
  const Index p = std::ssize(joint.names());
  const MatrixXd known =
      joint.Information(cells).topLeftCorner(p, p) + kKnown * MatrixXd::Identity(p, p);
  return Cofactor(known).diagonal().cwiseSqrt();
}

}  // namespace warmjoint
