#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/friction.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "models/foundation/random_stream.h"
#include "models/foundation/serialize.h"
#include "models/friction/evaluate_map.h"
#include "models/friction/friction_json.h"
#include "models/friction/prepared_map.h"
#include "tests/support/refusal.h"
#include "tests/support/shared_data.h"

namespace warmjoint {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pointwise;

constexpr double kTurn = 2 * std::numbers::pi;

/// Six kernels over position times velocity.
FrictionMap SmallMap() {
  return {{{MapQuantity::position, EvenAxis(-1, 1, 3)},
           {MapQuantity::velocity, SpeedAxis(0.5, 0.5, 1)}},
          KernelKind::normalised,
          {1, 2, 3, 4, 5, 6}};
}

TEST(FrictionMap, WeighsTheGoldenKernelsOverPositionAndVelocity) {
  const nlohmann::json& golden = test::Golden().at("rbf2");
  FrictionMap map;
  map.axes = {
      {MapQuantity::position, {golden.at("mu_p"), golden.at("sigma_p"), {}, Sides::together}},
      {MapQuantity::velocity, {golden.at("mu_v"), golden.at("sigma_v"), {}, Sides::together}}};
  for (const auto& [key, kind] :
       {std::pair("phi", KernelKind::plain), std::pair("phi_normalised", KernelKind::normalised)}) {
    map.kernels = kind;
    for (size_t i = 0; i < golden.at("p").size(); ++i) {
      for (size_t column = 0; column < map.size(); ++column) {
        // a weight of 1 on one kernel gives that kernel; 1e-12: a closed form
        map.weights.assign(map.size(), 0);
        map.weights[column] = 1;
        const double expected = golden.at(key)[i][column];
        const MapPoint<double> point{golden.at("p")[i], 0, golden.at("v")[i], 0, 0};
        EXPECT_NEAR(EvaluateMap(map, point), expected, 1e-12 * expected) << key << i << column;
      }
    }
  }
}

TEST(FrictionMap, IsMultipliedByItsFactor) {
  FrictionMap map{{{MapQuantity::energy, EvenAxis(-1, 0, 2)}}, KernelKind::normalised, {2, 2}};
  const auto at = [&](MapFactor factor, double v) {
    map.factor = factor;
    return EvaluateMap(map, MapPoint<double>{0, 0, v, -0.3, 0});
  };
  for (const double v : {-3.0, 0.0, 0.5}) {
    // equal weights of normalised kernels: their value everywhere; 1e-15: rounding of their sum
    EXPECT_NEAR(at(MapFactor::one, v), 2, 1e-15);
    EXPECT_NEAR(at(MapFactor::direction, v), 2 * Sign(v), 1e-15);
    EXPECT_NEAR(at(MapFactor::velocity, v), 2 * v, 1e-14);
  }
}

TEST(FrictionMap, ReadsBackWhatItWrites) {
  Friction friction;
  friction.parameters = {{"viscous", 1}, {"coulomb", 2}};
  friction.maps = {
      SmallMap(),
      {{{MapQuantity::motor_position, CircleAxis(kTurn, 2)}}, KernelKind::plain, {0.1, 0.2}}};
  const Tree written = FrictionToTree(friction);
  const Friction back = FrictionFrom({written, "friction.json"});
  EXPECT_EQ(FrictionToTree(back), written);
  EXPECT_EQ(back.maps[1].axes[0].kernels.period, kTurn);
  EXPECT_EQ(back.maps[0].axes[1].kernels.sides, Sides::apart);
}

TEST(FrictionMap, RefusesWhatDoesNotFit) {
  const auto refusal = [](const std::function<void(nlohmann::json&)>& spoil) -> std::string {
    nlohmann::json maps = WriteValue(std::vector{SmallMap()});
    spoil(maps[0]);
    return test::RefusalOf([&] { MapsFrom({Tree(maps), "friction.json"}); });
  };
  using nlohmann::json;
  EXPECT_THAT(refusal([](json& j) { j["weights"].push_back(7); }),
              HasSubstr("friction.json: a map has 7 weights; its axes span 6 kernels"));
  EXPECT_THAT(refusal([](json& j) { j["axes"][0]["width"] = -1; }),
              HasSubstr("axes.0.width is '-1'"));
  EXPECT_THAT(refusal([](json& j) { j["axes"][0]["width"] = "wide"; }),
              HasSubstr("width is 'wide'"));
  EXPECT_THAT(refusal([](json& j) { j["axes"][0]["period"] = 0; }),
              HasSubstr("axes.0.period is '0'"));
  EXPECT_THAT(refusal([](json& j) { j["axes"][0]["centres"][2] = -5; }), HasSubstr("ascend"));
  EXPECT_THAT(refusal([](json& j) { j["axes"][1]["centres"][1] = 0; }), HasSubstr("a centre at 0"));
  EXPECT_THAT(refusal([](json& j) { j["axes"][0]["quantity"] = "positon"; }),
              HasSubstr("did you mean 'position'"));
  EXPECT_THAT(refusal([](json& j) { j["factor"] = "velocty"; }),
              HasSubstr("did you mean 'velocity'"));
  EXPECT_THAT(refusal([](json& j) { j["axis"] = 1; }), HasSubstr("did you mean 'axes'"));
  EXPECT_THAT(refusal([](json& j) { j.erase("weights"); }), HasSubstr("weights' is missing"));
  EXPECT_THAT(refusal([](json& j) { j["axes"] = json::array(); }), HasSubstr("0 axes"));

  // of no file
  FrictionMap narrow = SmallMap();
  narrow.axes[0].kernels.width = 0;
  EXPECT_THAT(test::RefusalOf([&] { CheckMap(narrow, {"map"}); }), HasSubstr("width 0"));
}

std::vector<double> Kernels(const GaussianAxis& axis, KernelKind kind, double x) {
  std::vector<double> phi(axis.size());
  AxisKernels(axis, kind, x, phi.data());
  return phi;
}

/// Each kernel at each position of a golden entry, to 1e-12 (closed forms).
void ExpectGolden(const nlohmann::json& golden, const char* key, const GaussianAxis& axis,
                  KernelKind kind) {
  const std::vector<double> positions = golden.at("p");
  for (size_t i = 0; i < positions.size(); ++i) {
    const std::vector<double> expected = golden.at(key)[i];
    const std::vector<double> phi = Kernels(axis, kind, positions[i]);
    for (size_t k = 0; k < expected.size(); ++k) {
      EXPECT_NEAR(phi[k], expected[k], 1e-12 * expected[k]) << positions[i] << " " << k;
    }
  }
}

TEST(GaussianAxis, ReproducesTheGoldenKernels) {
  const nlohmann::json& golden = test::Golden().at("rbf1");
  const GaussianAxis axis{golden.at("mu"), golden.at("sigma"), {}, Sides::together};
  ExpectGolden(golden, "phi", axis, KernelKind::plain);
  ExpectGolden(golden, "phi_normalised", axis, KernelKind::normalised);

  const nlohmann::json& round = test::Golden().at("rbf_periodic");
  const GaussianAxis circle{round.at("mu"), round.at("sigma"), round.at("period"), Sides::together};
  ExpectGolden(round, "phi_normalised", circle, KernelKind::normalised);
}

TEST(GaussianAxis, StaysFiniteFarFromEveryCentre) {
  const GaussianAxis axis = EvenAxis(-1, 1, 5);
  EXPECT_THAT(Kernels(axis, KernelKind::normalised, 1e6), ElementsAre(0, 0, 0, 0, 1));
  EXPECT_THAT(Kernels(axis, KernelKind::normalised, -1e6), ElementsAre(1, 0, 0, 0, 0));
}

TEST(GaussianAxis, KeepsTheSidesApart) {
  const GaussianAxis axis = SpeedAxis(0.1, 1, 2);
  EXPECT_THAT(axis.centres, ElementsAre(-1, -0.1, 0.1, 1));
  const std::vector<double> forwards = Kernels(axis, KernelKind::normalised, 0.3);
  EXPECT_EQ(forwards[0] + forwards[1], 0);
  EXPECT_NEAR(forwards[2] + forwards[3], 1, 1e-15);
  EXPECT_THAT(Kernels(axis, KernelKind::normalised, 0), ElementsAre(0, 0, 0, 0));
}

TEST(GaussianAxis, GoesRoundTheCircle) {
  const GaussianAxis axis = CircleAxis(kTurn, 6);
  // 1e-12: rounding of an angle of 30 rad
  EXPECT_THAT(Kernels(axis, KernelKind::normalised, 0.3 + 5 * kTurn),
              Pointwise(DoubleNear(1e-12), Kernels(axis, KernelKind::normalised, 0.3)));
}

GaussianAxis Wide(GaussianAxis axis, double factor) {
  axis.width *= factor;
  return axis;
}

GaussianAxis UnevenAxis() {
  GaussianAxis axis;
  axis.centres = {-2, -0.5, 0.1, 0.2, 3};
  axis.width = 0.4;
  return axis;
}

/// Axes of every kind that maps have.
std::vector<GaussianAxis> AxesOfEveryKind() {
  return {EvenAxis(-3, 3, 40),   EvenAxis(-3, 3, 1),   Wide(EvenAxis(-3, 3, 12), 4),
          CircleAxis(kTurn, 36), CircleAxis(kTurn, 7), Wide(CircleAxis(kTurn, 8), 3),
          SpeedAxis(0.2, 2, 3),  SpeedAxis(0.2, 2, 5), SpeedAxis(0.2, 2, 1),
          UnevenAxis()};
}

/// The map with weights that go up and down.
FrictionMap Waved(FrictionMap map) {
  for (size_t i = 0; i < map.size(); ++i) {
    map.weights.push_back(std::sin(1.0 + 2.0 * static_cast<double>(i)));
  }
  return map;
}

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
      Compare(Waved({{{MapQuantity::position, axis}}, kind, {}, MapFactor::one}),
              MapQuantity::position, MapQuantity::velocity);
    }
  }
}

TEST(PreparedMap, IsTheSameOverProductsOfAxesWithAFactor) {
  for (const MapFactor factor : {MapFactor::one, MapFactor::direction, MapFactor::velocity}) {
    for (const GaussianAxis& axis : AxesOfEveryKind()) {
      Compare(Waved({{{MapQuantity::motor_position, axis},
                      {MapQuantity::velocity, SpeedAxis(0.1, 3, 6)},
                      {MapQuantity::energy, EvenAxis(-1, 1, 3)}},
                     KernelKind::normalised,
                     {},
                     factor}),
              MapQuantity::motor_position, MapQuantity::velocity);
    }
  }
}

TEST(PreparedMap, IsTheSameOverAPlaceAndASpeedOfAnyKind) {
  for (const GaussianAxis& axis : AxesOfEveryKind()) {
    // few speeds, which have a table, and many, which have none
    for (const int speeds : {1, 3, 4, 9}) {
      SCOPED_TRACE(testing::Message() << axis.size() << " centres, " << speeds << " speeds");
      const FrictionMap map = Waved(
          {{{MapQuantity::position, axis}, {MapQuantity::velocity, SpeedAxis(0.1, 3, speeds)}},
           KernelKind::normalised,
           {},
           MapFactor::direction});
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
      Compare(Waved({{{MapQuantity::motor_position, CircleAxis(kTurn, 25)},
                      {MapQuantity::energy, Wide(EvenAxis(-3, 3, centres), factor)}},
                     KernelKind::normalised,
                     {}}),
              MapQuantity::motor_position, MapQuantity::energy);
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
  EXPECT_EQ(EvaluateMap(SmallMap(), MapPoint<double>{0.3, 0, 0, 0, 0}), 0);
  EXPECT_GT(EvaluateMap(SmallMap(), MapPoint<double>{0.3, 0, 1e-9, 0, 0}), 2);
  const FrictionMap map{
      {{MapQuantity::velocity, SpeedAxis(0.1, 1, 2)}}, KernelKind::normalised, {1, 2, 3, 4}};
  EXPECT_EQ(PreparedMap(map).Value({}), 0);
}

}  // namespace
}  // namespace warmjoint
