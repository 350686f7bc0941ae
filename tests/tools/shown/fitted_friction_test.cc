#include "tools/shown/fitted_friction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "identification/uncertainty/tails.h"
#include "tests/tools/shown/warm_recording.h"

namespace warmjoint::shown {
namespace {

TEST(FittedFriction, HasCurvesAtThreeHeatsWithTheirDeviations) {
  const FitView view = WarmRecording().View();
  const auto curves = CurvesOf(view);
  ASSERT_EQ(curves.size(), 6u) << "cold, half as warm and warmest, either way";
  const double warmest = WarmestEnergy(view);
  const double energies[] = {0, 0, warmest / 2, warmest / 2, warmest, warmest};
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const FrictionCurve& one = curves[i];
    EXPECT_EQ(one.energy, energies[i]);
    const double way = i % 2 == 0 ? 1 : -1;
    const Eigen::VectorXd expected = 5 * one.speed.array() + way * (15 + one.energy);
    EXPECT_LT((one.force - expected).cwiseAbs().maxCoeff(), 1e-9);
    // as wide as the intervals of coulomb, 15 +- 0.2, and viscous, 5 +- 0.12, which are independent
    EXPECT_NEAR(kNormal95 * one.deviation[0], std::hypot(0.2, 0.12 * one.speed[0]), 1e-6);
  }
}

TEST(FittedFriction, WithMapsHasNoCurveButTheForceAtEachSample) {
  const MappedRecording mapped;
  const FitView view = mapped.View();
  EXPECT_TRUE(CurvesOf(view).empty());
  const auto forces = ForcesOf(view);
  ASSERT_EQ(forces.size(), 3u);
  for (Eigen::Index i = 0; i < view.time.size(); i += 50) {
    const double v = view.velocity[i];
    // the wave is smoothed by its kernels to 98 % of its 2 N.m
    EXPECT_NEAR(forces[0].force[i], 15 * Sign(v) + 5 * v + 2 * std::sin(view.motor_angle[i]), 0.05);
    EXPECT_NEAR(forces[2].force[i] - forces[0].force[i], Sign(v) * WarmestEnergy(view), 1e-9);
  }
}

TEST(FittedFriction, PartsTheMotorsMapFromTheRest) {
  const MappedRecording mapped;
  const FitView view = mapped.View();
  const MotorMaps maps = MotorMapsOf(view);
  EXPECT_LT((maps.with - view.fitted).cwiseAbs().maxCoeff(), 1e-9);
  const Eigen::VectorXd wave = 2 * view.motor_angle.array().sin();
  EXPECT_LT((maps.with - maps.without - wave).cwiseAbs().maxCoeff(), 0.05);
}

TEST(FittedFriction, HasALevelOverAngleAndVelocityColdAndWarm) {
  const MappedRecording mapped;
  const FitView view = mapped.View();
  const auto map = AngleMapOf(view);
  ASSERT_TRUE(map && map->over_motor);
  ASSERT_EQ(map->levels.size(), 2u);
  EXPECT_EQ(map->fastest, 0.9);
  const auto at = [&](const Eigen::MatrixXd& level, double angle, double v) {
    const auto row =
        static_cast<Eigen::Index>((v / 0.9 + 1) / 2 * static_cast<double>(level.rows()));
    return level(row,
                 static_cast<Eigen::Index>(angle / (2 * M_PI) * static_cast<double>(level.cols())));
  };
  // a cell is a sixtieth of the axes: 0.015 of velocity and 0.035 of angle
  EXPECT_NEAR(at(map->levels[0], M_PI / 2, 0.5), 15 + 2.5 + 2, 0.15);
  EXPECT_NEAR(at(map->levels[0], M_PI / 2, -0.5), 15 + 2.5 - 2, 0.15) << "not swapped";
  EXPECT_NEAR(at(map->levels[1], 3 * M_PI / 2, 0.5), 15 + 2.5 - 2 + WarmestEnergy(view), 0.15);
  EXPECT_FALSE(AngleMapOf(WarmRecording().View()));
}

}  // namespace
}  // namespace warmjoint::shown
