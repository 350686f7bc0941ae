#include "identification/typical_speeds.h"

#include <cmath>

#include "models/foundation/robust_noise.h"
#include "models/friction/sign.h"

namespace warmjoint {
namespace {

using Eigen::Index;

constexpr double kAlike =
    1.2214027581601699;     // e^0.2, a ratio; why: speeds nearer to each other are held as one
constexpr int kRounds = 5;  // why: from the edge of kAlike to the middle of what is within
constexpr double kSlow = 0.05, kFast = 0.95;  // why: a tenth of the samples lies about either

/// Mean of the speeds about one of them, moved on to the place where the speeds gather. rad/s or m/s
double Gathered(double speed, const Eigen::VectorXd& speeds) {
  for (int round = 0; round < kRounds; ++round) {
    const auto near = speeds.array() >= speed / kAlike && speeds.array() <= speed * kAlike;
    const Index count = near.count();
    if (count == 0) break;
    const double mean = near.select(speeds.array(), 0).sum() / static_cast<double>(count);
    if (mean == speed) break;
    speed = mean;
  }
  return speed;
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
    Eigen::VectorXd speeds = velocity(one_direction).cwiseAbs();
    double latest = 0;
    for (const double quantile : {kSlow, 0.5, kFast}) {
      const double speed = Gathered(QuantileInPlace(speeds, quantile), speeds);
      // a joint that moves at one speed has one figure
      if (latest > 0 && !(speed > latest * kAlike)) continue;
      latest = speed;
      SpeedGroup& group = all.emplace_back(SpeedGroup{direction * speed, {}});
      for (const Index i : one_direction) {
        const double own = std::abs(velocity[i]);
        if (own >= speed / kAlike && own <= speed * kAlike) group.samples.push_back(i);
      }
    }
  }
  return all;
}

std::vector<double> MeanLoads(const std::vector<SpeedGroup>& groups, const Eigen::VectorXd& load) {
  std::vector<double> means(groups.size(), 0.0);
  if (load.size() == 0) return means;
  const Eigen::VectorXd carried = load.cwiseAbs();
  for (size_t i = 0; i < groups.size(); ++i) means[i] = carried(groups[i].samples).mean();
  return means;
}

}  // namespace warmjoint
