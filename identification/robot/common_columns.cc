#include "identification/robot/common_columns.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "identification/fit/fit_data.h"
#include "identification/model/normal_equations.h"
#include "identification/robot/robot_joint.h"
#include "identification/uncertainty/tails.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kBlock =
    5;  // s; why: far longer than the filter's memory, and moves of robots end within it
constexpr double kLevelOfClaim = .01;
constexpr int kRounds =
    4;  // of noise and weights of the description's errors; why: both settle within two

/// The rate of a series by central differences within each recording. x: [N]
VectorXd RateOf(const VectorXd& x, const JointColumns& c) {
  const Index n = x.size();
  VectorXd rate = VectorXd::Zero(n);
  std::vector<Index> edges{0};
  edges.insert(edges.end(), c.samples.starts.begin(), c.samples.starts.end());
  edges.push_back(n);
  for (std::size_t part = 0; part + 1 < edges.size(); ++part) {
    const Index first = edges[part], last = edges[part + 1] - 1;
    for (Index i = first; i <= last; ++i) {
      const Index before = std::max(first, i - 1), after = std::min(last, i + 1);
      const double apart = static_cast<double>(after - before) * c.step;
      if (apart > 0) rate[i] = (x[after] - x[before]) / apart;
    }
  }
  return rate;
}

/// What one joint says of the unknowns.
struct Said {
  MatrixXd columns;      // [N x k]
  MatrixXd information;  // [k x k] inverse of the covariance of its own value
  VectorXd product;      // [k] information times value
  double left = 0;       // rms
};

/// Scores by blocks of time, and their scatter. rest: [n x k]; e: [n]; time: [n] s
MatrixXd ScatterByBlocks(const MatrixXd& rest, const VectorXd& e, const VectorXd& time) {
  std::map<Index, VectorXd> scores;
  for (Index i = 0; i < e.size(); ++i) {
    VectorXd& score =
        scores.try_emplace(static_cast<Index>(time[i] / kBlock), VectorXd::Zero(rest.cols()))
            .first->second;
    score += rest.row(i).transpose() * e[i];
  }
  MatrixXd sum = MatrixXd::Zero(rest.cols(), rest.cols());
  for (const auto& [block, score] : scores) sum += score * score.transpose();
  const auto count = static_cast<double>(scores.size());
  return sum * (count / std::max(count - 1, 1.0));
}

Said SaidBy(std::size_t joint, const JointColumns& c, double gain, const CommonColumns& further) {
  const Selection used{c.samples.keep, {}};
  const Index r = c.rigid.directions.cols();
  MatrixXd columns(c.velocity.size(), 6 + r);
  columns << c.rigid.force, c.velocity, c.forwards, -c.backwards, c.acceleration,
      VectorXd::Zero(c.velocity.size()), c.rigid.directions;
  const VectorXd y = Kept(c.samples.torque, used), direction = c.Direction();
  VectorXd prior = VectorXd::Zero(6 + r);
  prior.tail(r).setConstant(1 / (gain * gain));

  // least squares with the description's errors as wide as their prior, over the noise that it leaves, and friction
  // by the load that they give
  MatrixXd x, inverse;
  VectorXd solved = VectorXd::Zero(6 + r), e = y;
  for (int round = 0; round < kRounds; ++round) {
    const VectorXd load = c.carried.At({0, c.velocity.size()}, solved.tail(r) / gain);
    columns.col(5) = load.cwiseAbs().cwiseProduct(direction);
    x = Kept(columns, used);
    const double scale = round == 0 ? 0 : NoiseScaleOf(e).scale();
    inverse = InverseScaled(GramOf(x) + MatrixXd((scale * prior).asDiagonal()));
    solved = inverse * (x.transpose() * y);
    e = y - x * solved;
  }

  Said said;
  said.left = std::sqrt(e.squaredNorm() / static_cast<double>(e.size()));
  said.columns = further(joint, columns * solved);
  const MatrixXd z = Kept(said.columns, used);
  const MatrixXd rest = z - x * (inverse * (x.transpose() * z));
  const MatrixXd squares = z.transpose() * rest;
  const VectorXd value = SolveScaled(squares, z.transpose() * e);
  const MatrixXd scatter = ScatterByBlocks(rest, e - rest * value, Kept(c.samples.time, used));
  said.information = squares * InverseScaled(scatter) * squares;
  said.product = said.information * value;
  return said;
}

}  // namespace

CommonFit FitCommon(const std::vector<const JointColumns*>& joints,
                    const std::vector<GainGuess>& guesses, double middle_gain,
                    const CommonColumns& columns) {
  CommonFit fit;
  std::vector<Said> all;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const double gain = std::abs(guesses[j].Or(middle_gain));
    all.push_back(SaidBy(j, *joints[j], gain, columns));
  }
  if (all.size() < 2) return fit;
  const Index k = all.front().columns.cols();
  MatrixXd information = MatrixXd::Zero(k, k);
  VectorXd product = VectorXd::Zero(k);
  for (const Said& one : all) {
    information += one.information;
    product += one.product;
    fit.left += std::log(one.left + 1e-300);
    fit.columns.push_back(one.columns);
  }
  fit.value = SolveScaled(information, product);

  // the joints' scatter about their mean, where it is more than their noise
  double scatter = 0;
  for (const Said& one : all) {
    const VectorXd off = SolveScaled(one.information, one.product) - fit.value;
    scatter += off.dot(one.information * off);
  }
  const auto free = static_cast<double>(k) * static_cast<double>(all.size() - 1);
  fit.covariance = InverseScaled(information) * std::max(1.0, scatter / free);
  const double f = fit.value.dot(SolveScaled(fit.covariance, fit.value)) / static_cast<double>(k);
  fit.is_shown = PValueOfF(f, static_cast<double>(k), free) < kLevelOfClaim;
  return fit;
}

CommonFit FitDelay(const std::vector<const JointColumns*>& joints,
                   const std::vector<GainGuess>& guesses, double middle_gain) {
  return FitCommon(joints, guesses, middle_gain,
                   [&](std::size_t joint, const VectorXd& fitted) -> MatrixXd {
                     return -RateOf(fitted, *joints[joint]);
                   });
}

}  // namespace warmjoint
