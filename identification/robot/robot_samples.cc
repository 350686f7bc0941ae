#include "identification/robot/robot_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "identification/robot/robot_joint.h"
#include "models/foundation/low_pass.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Samples kept per period of the cut-off: twice as many as the filter's bandwidth needs; of long logs about the fewest that it needs.
constexpr double kThin = 4, kThinOfMany = 2.5;
constexpr double kMany =
    20'000;  // why: neighbours among more samples add no information, and fits take longer
constexpr double kEnds =
    .3;  // s left out at each end: three periods of 10 Hz, in which the filter has only one side
constexpr double kAtRest = .02;  // of the top speed

/// The filter of a log, or none where its rate is too low for one.
class Filter {
 public:
  Filter(double step, double cutoff) {
    if (cutoff < .49 / step) sections_ = ButterworthLowPass(2, cutoff, 1 / step);
  }
  VectorXd Of(const VectorXd& x) const {
    return sections_.empty() ? x : FilterZeroPhase(sections_, x);
  }
  MatrixXd OfEach(const MatrixXd& x) const {
    MatrixXd filtered(x.rows(), x.cols());
    for (Index j = 0; j < x.cols(); ++j) filtered.col(j) = Of(x.col(j));
    return filtered;
  }

 private:
  std::vector<Biquad> sections_;
};

/// Central differences; one-sided at the ends. x: [M x n]
MatrixXd Slope(const MatrixXd& x, double step) {
  const Index m = x.rows();
  MatrixXd slope(m, x.cols());
  slope.middleRows(1, m - 2) = (x.bottomRows(m - 2) - x.topRows(m - 2)) / (2 * step);
  slope.row(0) = (x.row(1) - x.row(0)) / step;
  slope.row(m - 1) = (x.row(m - 1) - x.row(m - 2)) / step;
  return slope;
}

/// Whether all samples within `reach` of each one hold. [M]
Eigen::Array<bool, Eigen::Dynamic, 1> AllWithin(const Eigen::Array<bool, Eigen::Dynamic, 1>& holds,
                                                Index reach) {
  const Index m = holds.size();
  Eigen::Array<bool, Eigen::Dynamic, 1> all = holds;
  Index last = -reach - 1;  // that does not hold
  for (Index i = 0; i < m; ++i) {
    if (!holds[i]) last = i;
    all[i] = i - last > reach;
  }
  for (Index i = m - 1, next = m + reach; i >= 0; --i) {
    if (!holds[i]) next = i;
    all[i] = all[i] && next - i > reach;
  }
  return all;
}

}  // namespace

RobotSamples PrepareRobot(const RobotMotionLog& log, const MatrixXd& coupling,
                          const VectorXd& gears, const RobotFilter& filter) {
  const Index m = log.position.rows(), n = log.position.cols();
  const Filter low_pass(log.step, filter.cutoff);
  const double rate = 1 / log.step;

  // the motion of the joints, and that of their motors
  const MatrixXd q = low_pass.OfEach(log.position);
  const MatrixXd v = Slope(q, log.step), a = Slope(v, log.step);
  const MatrixXd motor = log.position * coupling.transpose(), speed = v * coupling.transpose();

  // the samples that stay: thinned, without the ends
  const double kept = static_cast<double>(m) * log.step * kThin * filter.cutoff;
  const double thinning = kept > kMany ? kThinOfMany : kThin;
  const Index every = std::max<Index>(1, static_cast<Index>(rate / (thinning * filter.cutoff)));
  const Index cut = std::clamp<Index>(static_cast<Index>(kEnds * rate), 1, (m - 1) / 2);
  const auto thin = Eigen::seq(cut, m - 1 - cut, every);
  const auto thinned = [&](const MatrixXd& x) -> MatrixXd { return x(thin, Eigen::all); };

  RobotSamples samples;
  samples.step = log.step * static_cast<double>(every);
  samples.time = log.time(thin);
  samples.joint_position = thinned(q);
  samples.joint_velocity = thinned(v);
  samples.joint_acceleration = thinned(a);
  samples.position = samples.joint_position * coupling.transpose();
  samples.velocity = samples.joint_velocity * coupling.transpose();
  samples.acceleration = samples.joint_acceleration * coupling.transpose();
  samples.torque = thinned(low_pass.OfEach(log.torque));
  const Index count = samples.time.size();
  for (MatrixXd* matrix : {&samples.sign, &samples.forwards, &samples.backwards}) {
    matrix->resize(count, n);
  }
  constexpr Index shares = std::ssize(kSlowShares);
  samples.slow.resize(count, shares * n);
  samples.keep.resize(count, n);
  samples.top = speed.cwiseAbs().colwise().maxCoeff();
  samples.travel = motor.colwise().maxCoeff() - motor.colwise().minCoeff();

  for (Index j = 0; j < n; ++j) {
    const VectorXd u = speed.col(j);
    const VectorXd forwards = (u.array() > 0).cast<double>(),
                   backwards = (u.array() < 0).cast<double>();
    samples.sign.col(j) = (forwards - backwards)(thin);
    samples.forwards.col(j) = low_pass.Of(forwards)(thin);
    samples.backwards.col(j) = low_pass.Of(backwards)(thin);
    for (Index share = 0; share < shares; ++share) {
      const double bend = std::max(kSlowShares.at(share) * samples.top[j], 1e-12);
      const VectorXd slow = (-(u / bend).array().square()).exp() * (forwards - backwards).array();
      samples.slow.col(shares * j + share) = low_pass.Of(slow)(thin);
    }
    const auto moving =
        (u.array().abs() > std::max(kAtRest * samples.top[j], 1e-9)) && log.logged.col(j);
    samples.keep.col(j) = AllWithin(moving, static_cast<Index>(rate / filter.cutoff))(thin);

    MatrixXd& ripple = samples.ripple.emplace_back(count, gears[j] != 0 ? 4 * filter.harmonics : 0);
    for (Index column = 0; column < ripple.cols(); ++column) {
      const double turns = static_cast<double>(column / 4 + 1) * gears[j];
      const VectorXd& side = column % 2 == 0 ? forwards : backwards;
      const Eigen::ArrayXd angle = turns * motor.col(j).array();
      const double phase = column / 2 % 2 == 0 ? 0 : std::numbers::pi / 2;
      const VectorXd wave = (angle - phase).cos() * side.array();
      ripple.col(column) = low_pass.Of(wave)(thin);
    }
  }
  return samples;
}

}  // namespace warmjoint
