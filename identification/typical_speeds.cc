#include "identification/typical_speeds.h"

#include <cmath>

#include "models/foundation/robust_noise.h"
#include "models/friction/sign.h"

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr double kAlike = 0.2;  // of ln |v|; why: speeds nearer to each other are held as one
constexpr int kRounds = 5;      // why: from the edge of kAlike to the middle of what is within
constexpr double kSlow = 0.05, kFast = 0.95;  // why: a tenth of the samples lies about either

/// Those of some samples about a speed that the joint held, from one of the speeds on to where they gather.
SpeedGroup Gather(double speed, const std::vector<Index>& one_direction,
                  const Eigen::VectorXd& velocity) {
  SpeedGroup group;
  for (int round = 0; round < kRounds; ++round) {
    group.samples.clear();
    double sum = 0;
    for (const Index i : one_direction) {
      if (std::abs(std::log(std::abs(velocity[i]) / speed)) > kAlike) continue;
      group.samples.push_back(i);
      sum += velocity[i];
    }
    group.velocity = sum / static_cast<double>(group.samples.size());
    speed = std::abs(group.velocity);
  }
  return group;
}

}  // namespace

std::vector<SpeedGroup> TypicalSpeeds(const Eigen::VectorXd& velocity) {
  std::vector<SpeedGroup> all;
  for (const int direction : {1, -1}) {
    std::vector<Index> one_direction;
    for (Index i = 0; i < velocity.size(); ++i) {
      if (Sign(velocity[i]) == direction) one_direction.push_back(i);
    }
    if (one_direction.empty()) continue;
    double latest = 0;
    for (const double quantile : {kSlow, 0.5, kFast}) {
      Eigen::VectorXd speeds = velocity(one_direction).cwiseAbs();
      SpeedGroup group = Gather(QuantileInPlace(speeds, quantile), one_direction, velocity);
      const double speed = std::abs(group.velocity);
      // a joint that knows one speed has one figure
      if (latest > 0 && !(std::log(speed / latest) > kAlike)) continue;
      latest = speed;
      all.push_back(std::move(group));
    }
  }
  return all;
}

}  // namespace warmjoint
