#include "models/friction/prepared_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models/foundation/random_stream.h"
#include "models/friction/evaluate_map.h"
#include "tests/support/axes_of_every_kind.h"

namespace warmjoint {
namespace {

using test::AxesOfEveryKind;
using test::kTurn;
using test::Wide;

/// Compares with EvaluateMap at points within and far beyond the centres.
void Compare(const FrictionMap& map, MapQuantity first, MapQuantity second) {
  const PreparedMap prepared(map);
  RandomStream random({3, 1}, Stream::test);
  for (int i = 0; i < 400; ++i) {
    MapPoint<double> point{};
    const double scale = i % 4 == 0 ? 40 : 4;
    point[static_cast<size_t>(first)] = random.Uniform(-scale, scale);
    point[static_cast<size_t>(second)] = random.Uniform(-scale, scale);
    const double expected = EvaluateMap(map, point);
    // 3e-13 for the nearest kernel left out on each side, and 1e-13 of a spacing for centres that
    // are off the grid
    const double speed = std::abs(point[static_cast<size_t>(MapQuantity::velocity)]);
    EXPECT_NEAR(prepared.Value(point), expected, 1e-12 * (1 + speed)) << "point " << i;
  }
}

TEST(PreparedMap, IsTheSameOverOneAxisOfAnyKind) {
  for (const GaussianAxis& axis : AxesOfEveryKind()) {
    for (const KernelKind kind : {KernelKind::plain, KernelKind::normalised}) {
      SCOPED_TRACE(testing::Message()
                   << axis.size() << " centres, kind " << static_cast<int>(kind));
      FrictionMap map{{{MapQuantity::position, axis}}, kind, {}, MapFactor::one};
      for (size_t i = 0; i < map.size(); ++i) {
        map.weights.push_back(std::sin(1.0 + 2.0 * static_cast<double>(i)));
      }
      Compare(map, MapQuantity::position, MapQuantity::velocity);
    }
  }
}

TEST(PreparedMap, IsTheSameOverProductsOfAxesWithAFactor) {
  for (const MapFactor factor : {MapFactor::one, MapFactor::direction, MapFactor::velocity}) {
    for (const GaussianAxis& axis : AxesOfEveryKind()) {
      FrictionMap map{{{MapQuantity::motor_position, axis},
                       {MapQuantity::velocity, SpeedAxis(0.1, 3, 6)},
                       {MapQuantity::energy, EvenAxis(-1, 1, 3)}},
                      KernelKind::normalised,
                      {},
                      factor};
      for (size_t i = 0; i < map.size(); ++i) {
        map.weights.push_back(std::sin(1.0 + 2.0 * static_cast<double>(i)));
      }
      Compare(map, MapQuantity::motor_position, MapQuantity::velocity);
    }
  }
}

TEST(PreparedMap, IsTheSameOverAPlaceAndASpeedOfAnyKind) {
  for (const GaussianAxis& axis : AxesOfEveryKind()) {
    // few speeds, which have a table, and many, which have none
    for (const int speeds : {1, 3, 4, 9}) {
      SCOPED_TRACE(testing::Message() << axis.size() << " centres, " << speeds << " speeds");
      FrictionMap map{
          {{MapQuantity::position, axis}, {MapQuantity::velocity, SpeedAxis(0.1, 3, speeds)}},
          KernelKind::normalised,
          {},
          MapFactor::direction};
      for (size_t i = 0; i < map.size(); ++i) {
        map.weights.push_back(std::sin(1.0 + 2.0 * static_cast<double>(i)));
      }
      Compare(map, MapQuantity::position, MapQuantity::velocity);
      // at rest neither side of the speeds counts
      EXPECT_EQ(PreparedMap(map).Value({0.3}), 0);
    }
  }
}

TEST(PreparedMap, IsTheSameOverAnyNumberOfCentresOfTheShorterAxis) {
  for (int centres = 1; centres <= 24; ++centres) {
    for (const double factor : {0.6, 1.0, 1.7}) {
      SCOPED_TRACE(testing::Message() << centres << " centres, width times " << factor);
      FrictionMap map{{{MapQuantity::motor_position, CircleAxis(kTurn, 25)},
                       {MapQuantity::energy, Wide(EvenAxis(-3, 3, centres), factor)}},
                      KernelKind::normalised,
                      {}};
      for (size_t i = 0; i < map.size(); ++i) {
        map.weights.push_back(std::sin(1.0 + 2.0 * static_cast<double>(i)));
      }
      Compare(map, MapQuantity::motor_position, MapQuantity::energy);
    }
  }
}

TEST(PreparedMap, PassesOnWhatIsNoNumber) {
  for (const GaussianAxis& axis : AxesOfEveryKind()) {
    const FrictionMap map{{{MapQuantity::position, axis}},
                          KernelKind::normalised,
                          std::vector<double>(axis.size(), 1.0)};
    EXPECT_TRUE(std::isnan(PreparedMap(map).Value({std::nan("")}))) << axis.size() << " centres";
  }
}

TEST(PreparedMap, VanishesAtRestWhereItsSidesAreApart) {
  const FrictionMap map{
      {{MapQuantity::velocity, SpeedAxis(0.1, 1, 2)}}, KernelKind::normalised, {1, 2, 3, 4}};
  EXPECT_EQ(PreparedMap(map).Value({}), 0);
}

}  // namespace
}  // namespace warmjoint
