#include "identification/maps/map_choice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "identification/fit_data.h"
#include "identification/linear/linear_laws.h"
#include "identification/maps/map_options.h"
#include "identification/preparation/select.h"
#include "tests/support/travelling.h"

namespace warmjoint {
namespace {

/// Law viscous_coulomb, and the torque of a recording.
MapProblem ProblemOf(const Measurements& m, const Selection& selection) {
  return {{},
          Kept(PointsOf(m), selection),
          Kept(LawColumns(*FindLaw("viscous_coulomb"), m.velocity), selection),
          Kept(m.torque, selection),
          selection};
}

MapProblem Moving(const Measurements& m) { return ProblemOf(m, SelectMoving(m)); }

/// Maps over position for each direction, of 10, 20, 40 and 80 kernels.
std::vector<std::vector<FrictionMap>> Candidates(const MapPoints& points) {
  std::vector<std::vector<FrictionMap>> candidates;
  for (const int count : {10, 20, 40, 80}) {
    candidates.push_back(
        {{{RangeAxis(MapQuantity::position, points, count, 1), VelocityAxis(points, 1, 1)},
          KernelKind::normalised,
          {}}});
  }
  return candidates;
}

/// Twenty minutes between -1 and 1 rad of a joint whose level varies over position in so many
/// cycles.
Measurements Wavy(double cycles, std::uint64_t seed) {
  const Eigen::VectorXd velocity =
      test::Travel(12000, 0.1, 1, {0.1, 0.5, 0.23, 0.8, 0.31, 0.62, 0.17});
  Measurements m = test::Record(0.1, velocity, velocity);
  m.torque =
      5 * velocity.array() +
      velocity.array().sign() * (15 + (std::numbers::pi * cycles * m.position.array()).sin());
  test::AddNoise(m, 0.5, 0, seed);
  return m;
}

TEST(ChooseMaps, TakesNoMoreKernelsThanAreNeeded) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const MapProblem smooth = Moving(Wavy(1.5, seed));
    const auto candidates = Candidates(smooth.points);
    EXPECT_LE(ChooseMaps(smooth, candidates, StrengthRule::cross_validation, 5).candidate, 1);

    // 20 cycles between 40 centres are two to a cycle, which is too few
    const MapProblem rippled = Moving(Wavy(20, seed));
    EXPECT_EQ(ChooseMaps(rippled, candidates, StrengthRule::cross_validation, 5).candidate, 3);
  }
}

/// Ten passes to and fro over 0 to 1 rad with one speed for each part of the way, held by a
/// controller: the speed errs by half a per cent, and the torque works against the error.
Measurements OneSpeedForEachPosition(double gain, std::uint64_t seed) {
  RandomStream random({seed, 2}, Stream::motion);
  const Eigen::Index n = 8000;
  Eigen::VectorXd velocity(n), torque(n);
  double position = 0, direction = 1, error = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double speed = position < 0.3 ? 0.2 : position < 0.6 ? 1 : 0.5;
    error = 0.9 * error + 0.005 * std::sqrt(1 - 0.81) * random.Normal();
    velocity[i] = direction * speed + error;
    torque[i] = 5 * direction * speed + 15 * direction - gain * error + 0.1 * random.Normal();
    position += 0.005 * direction * speed;
    if (position > 1 || position < 0) direction = -direction;
  }
  return test::Record(0.005, velocity, torque);
}

/// The samples away from where its speed changes.
Selection AwayFromChanges(const Measurements& m) {
  Selection selection = SelectMoving(m);
  for (const double change : {0.3, 0.6}) {
    selection.keep = selection.keep && (m.position.array() - change).abs() > 0.08;
  }
  return selection;
}

TEST(ChooseMaps, LetsNoWeightsCancelAgainstAParameterOfTheWrongSign) {
  const Measurements m = OneSpeedForEachPosition(400, 1);
  MapProblem problem = ProblemOf(m, AwayFromChanges(m));
  const auto candidates = Candidates(problem.points);
  const auto fit = [&] {
    const ChosenMaps chosen = ChooseMaps(problem, candidates, StrengthRule::cross_validation, 5);
    problem.maps = candidates[chosen.candidate];
    return *FitMaps(problem, chosen.strength);
  };
  // held-out parts know no better: the controller answers alike in all of them
  EXPECT_LT(fit().x[0], -100);
  problem.lower = {0, 0};
  const MapFit possible = fit();
  EXPECT_GE(possible.x[0], 0);
  EXPECT_GE(possible.x[1], 0);
}

}  // namespace
}  // namespace warmjoint
