#include <gmock/gmock.h>
#include <warmjoint/friction.h>

#include <functional>
#include <numbers>

#include "models/friction/evaluate_map.h"
#include "models/friction/friction_json.h"
#include "tests/support/shared_data.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

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

TEST(FrictionMap, IsZeroAtRestWhereItsSidesAreApart) {
  EXPECT_EQ(EvaluateMap(SmallMap(), MapPoint<double>{0.3, 0, 0, 0, 0}), 0);
  EXPECT_GT(EvaluateMap(SmallMap(), MapPoint<double>{0.3, 0, 1e-9, 0, 0}), 2);
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
  const FrictionMap back = MapsFrom({MapsToTree({map}), "friction.json"}).at(0);
  EXPECT_EQ(back.factor, MapFactor::velocity);
}

TEST(FrictionMap, ReadsBackWhatItWrites) {
  Friction friction;
  friction.parameters = {{"viscous", 1}, {"coulomb", 2}};
  const double turn = 2 * std::numbers::pi;
  friction.maps = {
      SmallMap(),
      {{{MapQuantity::motor_position, CircleAxis(turn, 2)}}, KernelKind::plain, {0.1, 0.2}}};
  const Tree written = FrictionToTree(friction);
  const Friction back = FrictionFrom({written, "friction.json"});
  EXPECT_EQ(FrictionToTree(back), written);
  EXPECT_EQ(back.maps[1].axes[0].kernels.period, turn);
  EXPECT_EQ(back.maps[0].axes[1].kernels.sides, Sides::apart);
}

TEST(FrictionMap, RefusesWhatDoesNotFit) {
  const auto refusal = [](const std::function<void(nlohmann::json&)>& spoil) -> std::string {
    nlohmann::json maps = MapsToTree({SmallMap()});
    spoil(maps[0]);
    try {
      MapsFrom({Tree(maps), "friction.json"});
    } catch (const BadInput& bad) {
      return bad.what();
    }
    return "accepted";
  };
  using nlohmann::json;
  EXPECT_THAT(refusal([](json& j) { j["weights"].push_back(7); }),
              HasSubstr("friction.json: a map has 7 weights; its axes span 6 kernels"));
  EXPECT_THAT(refusal([](json& j) { j["axes"][0]["width"] = -1; }), HasSubstr("width -1"));
  EXPECT_THAT(refusal([](json& j) { j["axes"][0]["width"] = "wide"; }),
              HasSubstr("width is 'wide'"));
  EXPECT_THAT(refusal([](json& j) { j["axes"][0]["period"] = 0; }), HasSubstr("period 0"));
  EXPECT_THAT(refusal([](json& j) { j["axes"][0]["centres"][2] = -5; }), HasSubstr("ascend"));
  EXPECT_THAT(refusal([](json& j) { j["axes"][1]["centres"][1] = 0; }), HasSubstr("a centre at 0"));
  EXPECT_THAT(refusal([](json& j) { j["axes"][0]["quantity"] = "positon"; }),
              HasSubstr("did you mean 'position'"));
  EXPECT_THAT(refusal([](json& j) { j["factor"] = "velocty"; }),
              HasSubstr("did you mean 'velocity'"));
  EXPECT_THAT(refusal([](json& j) { j["axis"] = 1; }), HasSubstr("did you mean 'axes'"));
  EXPECT_THAT(refusal([](json& j) { j.erase("weights"); }), HasSubstr("weights' is missing"));
  EXPECT_THAT(refusal([](json& j) { j["axes"] = json::array(); }), HasSubstr("0 axes"));
}

}  // namespace
}  // namespace warmjoint
