// Compensator `least-squares`: slope and level by recursive least squares that forgets.
//
// theta[i] = theta[i-1] + P[i] x[i] e[i], P[i] = (P[i-1] - P x x^T P / (lambda + x^T P x)) / lambda, lambda = exp(-dt / over), x =
// [|v|, 1]; it begins with the line through the day before. A residual counts up to three deviations of the noise, so that a
// push does not become friction at once.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "models/friction/sign.h"
#include "tools/compensate/arms/arm_list.h"

namespace warmjoint {
namespace {

struct ForgettingOptions {
  double over = 60;

  template <class A>
  void Serialize(A* a) {
    a->Field("over", &over,
             {.unit = "s", .bounds = {.above = 0}, .meaning = "time over which it forgets, s"});
  }
};

Eigen::VectorXd AlongForgetting(const CompensatorInput& input) {
  const LogSamples& log = input.log;
  const SpeedLine line = LineOf(input.before, 0, input.before.time.tail<1>()[0]);
  const double most = 3 * NoiseOf(input.before), over = input.options.Get<ForgettingOptions>().over;
  const Eigen::VectorXd steps = StepsOf(log);
  Eigen::Vector2d theta(line.viscous, line.level);
  Eigen::Matrix2d spread = Eigen::Matrix2d::Identity();
  Eigen::VectorXd found = Eigen::VectorXd::Zero(log.size());
  for (Eigen::Index i = 0; i < log.size(); ++i) {
    if (log.velocity[i] == 0) continue;
    const double sign = Sign(log.velocity[i]), keep = std::exp(-steps[i] / over);
    const Eigen::Vector2d x(std::abs(log.velocity[i]), 1);
    found[i] = sign * x.dot(theta);
    // as before this sample, then with it
    const double error = std::clamp(sign * (log.torque[i] - found[i]), -most, most);
    const Eigen::Vector2d gain = spread * x / (keep + x.dot(spread * x));
    theta += gain * error;
    spread = ((spread - gain * x.transpose() * spread) / keep).eval();
  }
  return found;
}

}  // namespace

CompensatorArm ForgettingLeastSquares() {
  return {"least-squares", "slope and level by recursive least squares that forgets",
          ForgettingOptions{}, AlongForgetting};
}

}  // namespace warmjoint
