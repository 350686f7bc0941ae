#include "identification/robot/find_heat.h"

#include <Eigen/QR>
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

constexpr int kTries = 8;
// of the log: a faster time constant would follow the motion, not its losses
constexpr double kShare = 30;
// why: within less than 20 s no housing of a joint warms, and within ten periods E follows the motion
constexpr double kShortest = 20, kPeriods = 10;  // s

/// Mean time from one reversal to the next but one, s; the log's length where the joint does not turn back.
double PeriodOf(const JointColumns& c) {
  double reversals = 0, last = 0;
  for (const double sign : c.sign) {
    if (sign == 0) continue;
    if (sign == -last) ++reversals;
    last = sign;
  }
  const double length = c.samples.time.tail(1)[0] - c.samples.time[0];
  return 2 * length / std::max(reversals, 2.0);
}

/// E at unit gain by given losses, times the direction of friction. loss: [N]
VectorXd HeatColumn(const JointColumns& c, const VectorXd& loss, double tau) {
  const double pole = std::exp(-c.step / tau);
  VectorXd column(loss.size());
  double e = 0;
  std::size_t next = 0;
  for (Index i = 0; i < loss.size(); ++i) {
    if (next < c.samples.starts.size() && c.samples.starts[next] == i) e = 0, ++next;
    column[i] = e;
    e = pole * e + (1 - pole) * loss[i];
  }
  return column.cwiseProduct(c.Direction());
}

}  // namespace

HeatGuess FindHeat(const JointColumns& c, const JointFit& cold, const JointQuestion& q) {
  const Selection used{c.samples.keep, {}};
  const VectorXd& time = c.samples.time;
  const double length = time.tail(1)[0] - time[0];

  // the derivatives of the fit, with rows of their own for its priors
  const ModelAt model(cold.model, cold.solved.x);
  const ModelRows rows = model.All();
  const MatrixXd j = Kept(rows.derivatives, used);
  const double scale = cold.solved.noise.scale();
  MatrixXd h = j.transpose() * j / scale;
  h += cold.model.PriorPrecision();
  const MatrixXd inverse = InverseScaled(h);
  const auto rest_of = [&](const VectorXd& z) -> VectorXd {
    return z - j * (inverse * (j.transpose() * z / scale));
  };
  const VectorXd e = Kept(cold.solved.residual, used);
  const VectorXd kept_time = Kept(time, used);
  const double block = std::max(5.0, length / 60);

  // the losses of the cold friction
  ModelRows friction;
  model.LossesAlong({0, c.velocity.size()}, friction);
  const VectorXd loss = c.velocity.cwiseAbs().cwiseProduct(c.sign.cwiseProduct(friction.force));

  const double shortest = std::max({length / kShare, kShortest, kPeriods * PeriodOf(c)});
  HeatGuess best;
  best.shortest = shortest;
  double blocks = 1;
  if (shortest > length) return best;
  for (int i = 0; i < kTries; ++i) {
    const double tau = shortest * std::pow(length / shortest, i / (kTries - 1.0));
    const VectorXd z = rest_of(Kept(HeatColumn(c, loss, tau), used));
    const double squares = z.squaredNorm();
    if (!(squares > 0)) continue;
    const double k = z.dot(e) / squares;
    // scores by blocks of time
    std::map<Index, double> scores;
    for (Index n = 0; n < e.size(); ++n) {
      scores[static_cast<Index>((kept_time[n] - time[0]) / block)] += z[n] * (e[n] - k * z[n]);
    }
    double sum = 0;
    for (const auto& [at, score] : scores) sum += score * score;
    if (!(sum > 0)) continue;
    const auto count = static_cast<double>(scores.size());
    const double wald = k * squares / std::sqrt(sum * count / std::max(count - 1, 1.0));
    if (std::abs(wald) <= std::abs(best.deviations)) continue;
    best = {false, wald, k, tau, 0, shortest};
    blocks = count;
  }
  const double level_of_one = q.error_level / kTries / std::max(q.joints, 1);
  // the test is one-sided, for friction that falls
  best.limit = StudentQuantile(std::max(blocks - 1, 1.0), 1 - 2 * level_of_one);
  best.warms = best.deviations < -best.limit;
  return best;
}

}  // namespace warmjoint
