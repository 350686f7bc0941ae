// The heat that a fit found beside the temperature of its log.
#include "identification/report/heat_beside_temperature.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "identification/answer/identify.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/preparation/prepare.h"
#include "identification/preparation/select.h"
#include "identification/read_options.h"
#include "tests/support/coloured_noise.h"
#include "tests/support/warm_recording.h"

namespace warmjoint {
namespace {

constexpr double kPerLoss = 0.8;  // K/W
constexpr double kNoise = 0.1;    // K

/// An hour of the joint of Table I, whose case is warmed by its losses, by a thermometer that lags.
Measurements WithThermometer(std::uint64_t seed, double lag) {
  Measurements m =
      test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(3600, seed), 0.3, seed);
  const Eigen::VectorXd energy = PredictFriction(test::TableOne(), m).energy;
  const Eigen::VectorXd rise = Lagged(energy, lag, m.time, {}) * kPerLoss / -3;
  m.temperature = rise.array() + 25;
  RandomStream random({seed, 3}, Stream::torque_noise);
  for (double& temperature : *m.temperature) temperature += kNoise * random.Normal();
  return m;
}

Estimate Fitted(const Measurements& m, const std::string& name = "energy-ml") {
  const Identifier& identifier = FindIdentifier(name);
  const Options options = ReadOptions(identifier.options, {}, {});
  const Selection selection = SelectMoving(m);
  return IdentifyUnjudged(identifier, {Prepare(m, selection), options, {}});
}

const EstimatedParameter* Find(const Estimate& estimate, const std::string& name) {
  const auto& rows = estimate.temperature;
  const auto found = std::ranges::find(rows, name, &EstimatedParameter::name);
  return found == rows.end() ? nullptr : &*found;
}

TEST(HeatBesideTemperature, FindsTheSlopesOfAThermometer) {
  int inside = 0;
  constexpr int logs = 20;
  for (int seed = 1; seed <= logs; ++seed) {
    const Estimate estimate = Fitted(WithThermometer(static_cast<std::uint64_t>(seed), 0));
    ASSERT_TRUE(Find(estimate, "per_loss")) << estimate.message;
    EXPECT_LT(Find(estimate, "correlation")->value, -0.98);
    EXPECT_EQ(Find(estimate, "per_energy")->unit, "K/(N.m)");
    EXPECT_EQ(Find(estimate, "lag")->value, 0);
    EXPECT_NEAR(Find(estimate, "rmse")->value, kNoise / std::sqrt(2), 0.01);  // means of two
    const auto& [lower, upper] = *Find(estimate, "per_loss")->interval95;
    inside += lower <= kPerLoss && kPerLoss <= upper;
  }
  // of twenty intervals of 95 %, fewer than 16 hold the truth once in 390 times
  EXPECT_GE(inside, 16);
}

TEST(HeatBesideTemperature, ALagOfTheThermometerIsFound) {
  const Estimate estimate = Fitted(WithThermometer(4, 200));
  EXPECT_NEAR(Find(estimate, "lag")->value, 200, 60);
  EXPECT_NEAR(Find(estimate, "per_loss")->value, kPerLoss, 0.06);
}

TEST(HeatBesideTemperature, TheFitDoesNotUseIt) {
  const Measurements with = WithThermometer(5, 0);
  Measurements without = with;
  without.temperature.reset();
  const Estimate one = Fitted(with), other = Fitted(without);
  EXPECT_TRUE(other.temperature.empty());
  ASSERT_EQ(one.parameters.size(), other.parameters.size());
  for (size_t i = 0; i < one.parameters.size(); ++i) {
    EXPECT_EQ(one.parameters[i].value, other.parameters[i].value);
  }
}

TEST(HeatBesideTemperature, ATemperatureOfItsOwnIsSaidToBeLooselyTied) {
  // a slow random course, which an interval for white noise would tie to E
  int tied = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Measurements m = WithThermometer(seed, 0);
    m.temperature = 25 + test::Coloured(m.size(), 0.998, seed).array();
    const Estimate estimate = Fitted(m);
    ASSERT_FALSE(estimate.temperature.empty());
    const auto& interval = Find(estimate, "per_energy")->interval95;
    tied += interval && ((*interval)[0] > 0 || (*interval)[1] < 0);
  }
  // 95 % intervals would tie one of twenty; colour of so slow a course is known to half
  EXPECT_LE(tied, 6);
}

TEST(HeatBesideTemperature, SaysNothingWhereThereIsNothing) {
  Measurements flat = WithThermometer(6, 0);
  flat.temperature->setConstant(25);
  EXPECT_TRUE(Fitted(flat).temperature.empty());
  EXPECT_TRUE(Fitted(WithThermometer(6, 0), "nominal-ls").temperature.empty());
}

}  // namespace
}  // namespace warmjoint
