#include "models/friction/level_terms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "models/friction/check_friction.h"

namespace warmjoint {
namespace {

Friction With(std::vector<FrictionMap> maps, double load_gain = 0) {
  Friction friction;
  friction.law = "coulomb";
  friction.parameters = {{"coulomb", 10}};
  friction.maps = std::move(maps);
  friction.load_gain = load_gain;
  friction.gear = 100;
  return friction;
}

TEST(LevelTerms, AreNoneWithoutAMap) {
  EXPECT_TRUE(LevelTerms(With({}, 0.1)).empty());
  EXPECT_TRUE(NeedsLoad(With({}, 0.1)));
  EXPECT_FALSE(NeedsLoad(With({})));
}

TEST(LevelTerms, TakeTheMotorsAngleFromTheGear) {
  // one bump at a motor angle of 0: again after each turn of the motor, at 2 pi / 100
  FrictionMap bump{{{MapQuantity::motor_position, CircleAxis(2 * std::numbers::pi, 4)}},
                   KernelKind::plain,
                   {1, 0, 0, 0}};
  bump.axes[0].kernels.width = 0.1;
  const LevelTerms terms(With({bump}));
  const double turn = 2 * std::numbers::pi / 100;
  for (const double turns : {-3.0, 0.0, 1.0, 12.0}) {
    EXPECT_NEAR(terms.At(1, 0.5, {turns * turn}), 1, 1e-12);
    EXPECT_NEAR(terms.At(1, 0.5, {(turns + 0.5) * turn}), 0, 1e-12);
  }
}

TEST(LevelTerms, AddAForceToOneSideAndTakeItFromTheOther) {
  const FrictionMap force{
      {{MapQuantity::position, EvenAxis(-1, 1, 2)}}, KernelKind::normalised, {0.5, 0.5}};
  FrictionMap level = force;
  level.factor = MapFactor::direction;
  EXPECT_DOUBLE_EQ(LevelTerms(With({force})).At(1, 0, {}), 0.5);
  EXPECT_DOUBLE_EQ(LevelTerms(With({force})).At(-1, 0, {}), -0.5);
  EXPECT_DOUBLE_EQ(LevelTerms(With({level})).At(-1, 0, {}), 0.5);
}

TEST(LevelTerms, TakeNoMapThatWouldKeepThemForMinutes) {
  const auto cube = [](int axes, int centres) {
    FrictionMap map;
    for (const MapQuantity quantity :
         {MapQuantity::position, MapQuantity::velocity, MapQuantity::energy, MapQuantity::load}) {
      if (static_cast<int>(map.axes.size()) < axes) {
        map.axes.push_back({quantity, EvenAxis(-1, 1, centres)});
      }
    }
    map.weights.assign(map.size(), 0.1);
    return map;
  };
  const auto refusal = [](Friction friction) -> std::string {
    friction.thermal = Thermal{-0.4, 900};
    try {
      CheckFriction(friction, {"friction.json"});
    } catch (const BadInput& bad) {
      return bad.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal(With({cube(2, 128)})), "accepted");
  EXPECT_EQ(refusal(With({cube(3, 32)})), "accepted");
  EXPECT_EQ(refusal(With({cube(4, 8)})), "accepted");
  EXPECT_THAT(refusal(With({cube(4, 32)})), testing::HasSubstr("friction.json: its maps need"));
  // many maps add up
  EXPECT_THAT(refusal(With(std::vector(100, cube(3, 32)))), testing::HasSubstr("fewer centres"));
}

TEST(LevelTerms, KnowTheirSteepestSlopeAndTheirSizeAtRest) {
  const FrictionMap viscous{{{MapQuantity::position, EvenAxis(-1, 1, 3)}},
                            KernelKind::normalised,
                            {1, 7, 2},
                            MapFactor::velocity};
  const LevelTerms slope(With({viscous}));
  // between centres one width apart the highest weighs 1 / (1 + 2 exp(-1/2)), at its centre
  const double other = std::exp(-0.5);
  EXPECT_NEAR(slope.SteepestSlope(), (7 + 3 * other) / (1 + 2 * other), 1e-12);
  EXPECT_LT(slope.LargestAtRest(), 1e-300);

  const FrictionMap rises{
      {{MapQuantity::velocity, SpeedAxis(0.1, 0.5, 2)}}, KernelKind::plain, {-2, -1, 1, 2}};
  EXPECT_GT(LevelTerms(With({rises})).SteepestSlope(), 1);
  EXPECT_GT(LevelTerms(With({rises})).LargestAtRest(), 0.5);
}

}  // namespace
}  // namespace warmjoint
