#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "models/foundation/bad_input.h"
#include "scenarios/motion.h"

namespace warmjoint {
namespace {

constexpr int kCorners = 500;  // in the fastest harmonic's period: its slopes are off by 0.6 %
constexpr double kMostCorners = 4e6;

void CheckCorners(double corners) {
  if (corners <= kMostCorners) return;
  Refuse({},
         "motion makes more than {:g} corners; shorten duration or lengthen its period or pause",
         kMostCorners);
}

std::vector<VelocityCorner> PlanFourier(const FourierMotion& fourier, double duration,
                                        RandomStream& random) {
  const auto harmonics = static_cast<Eigen::Index>(fourier.harmonics);
  Eigen::VectorXd cosines(harmonics), sines(harmonics);
  for (Eigen::Index k = 0; k < harmonics; ++k) {
    cosines[k] = random.Normal();
    sines[k] = random.Normal();
  }
  cosines[0] -= cosines.sum();  // from rest

  // one period, scaled
  const Eigen::Index steps = kCorners * harmonics;
  CheckCorners(duration / fourier.period * static_cast<double>(steps));
  const Eigen::ArrayXd orders =
      Eigen::ArrayXd::LinSpaced(harmonics, 1, static_cast<double>(harmonics));
  Eigen::VectorXd velocity(steps);
  for (Eigen::Index i = 0; i < steps; ++i) {
    const double turn = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(steps);
    const Eigen::ArrayXd angles = turn * orders;
    velocity[i] = cosines.dot(angles.cos().matrix()) + sines.dot(angles.sin().matrix());
  }
  velocity *= fourier.speed / velocity.cwiseAbs().maxCoeff();
  velocity[0] = 0;

  // again and again
  std::vector<VelocityCorner> corners;
  const double step = fourier.period / static_cast<double>(steps);
  for (Eigen::Index i = 0;; ++i) {
    const double time = step * static_cast<double>(i);
    corners.push_back({time, velocity[i % steps]});
    if (time >= duration) return corners;
  }
}

std::vector<VelocityCorner> PlanMoves(const MovesBetween& moves, double duration,
                                      RandomStream& random) {
  const auto [lower, upper] = moves.between;
  double place = 0.5 * (lower + upper), time = 0;
  std::vector<VelocityCorner> corners{{0, 0}};
  while (time < duration) {
    const double target = random.Uniform(lower, upper);
    const double distance = std::abs(target - place);

    // up to the speed, or as far as half the distance lets it go
    const double speed = std::min(moves.speed, std::sqrt(moves.acceleration * distance));
    const double ramp = speed / moves.acceleration;
    const double steady = speed > 0 ? distance / speed - ramp : 0;
    if (ramp < MovesBetween::kShortestRamp) continue;
    // ramp, steady speed, ramp and pause
    const double velocity = std::copysign(speed, target - place);
    corners.push_back({time += ramp, velocity});
    if (steady > 1e-9) corners.push_back({time += steady, velocity});
    corners.push_back({time += ramp, 0});
    if (moves.pause > 0) corners.push_back({time += moves.pause, 0});
    place = target;
    CheckCorners(static_cast<double>(corners.size()));
  }
  return corners;
}

}  // namespace

bool FollowsCorners(const Motion& motion) {
  return !motion.corners.empty() || motion.fourier || motion.moves;
}

std::vector<VelocityCorner> PlanCorners(const Motion& motion, double duration,
                                        RandomStream& random) {
  if (motion.fourier) return PlanFourier(*motion.fourier, duration, random);
  if (motion.moves) return PlanMoves(*motion.moves, duration, random);
  return motion.corners;
}

}  // namespace warmjoint
