#include "identification/maps/make_bands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/prepared_log.h>

#include <algorithm>
#include <cmath>

#include "identification/forward/log_trajectory.h"
#include "identification/maps/holes.h"
#include "tests/support/judging.h"
#include "tests/support/travelling.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

/// A joint whose level varies over its position.
Friction Truth(FrictionMap map) {
  Friction friction{"viscous_coulomb", {{"viscous", 0.5}, {"coulomb", 2}}, {}, 0, 100};
  friction.maps = {std::move(map)};
  return friction;
}

struct Trial {
  Measurements measurements;
  Estimate estimate;
};

Trial Identify(const Friction& truth, const char* name, std::uint64_t seed, double colour,
               const std::map<std::string, std::string>& given) {
  const Eigen::VectorXd velocity = test::Travel(6000, 0.1, 1, {0.31, 0.57, 0.83});
  // between the limits
  const Measurements m = test::RecordTravel(truth, 0.1, velocity, -1, 0.1, colour, seed);
  return {m, test::Fitted(name, m, given)};
}

/// What the places of bands over position and direction make of the truth there.
struct Cover {
  int held = 0;
  int all = 0;
  double errors = 0;     // sum of squares, (N.m)^2
  double variances = 0;  // sum, (N.m)^2

  void Add(const Trial& trial, const Friction& truth) {
    const MapBand& band = trial.estimate.bands[0];
    Measurements at = trial.measurements;
    const auto size = static_cast<Eigen::Index>(band.points.size());
    at.time = Eigen::VectorXd::LinSpaced(size, 0, 1);
    at.position.resize(size);
    at.velocity.resize(size);
    at.torque = Eigen::VectorXd::Zero(size);
    for (Eigen::Index i = 0; i < size; ++i) {
      at.position[i] = band.points[static_cast<size_t>(i)][0];
      at.velocity[i] = band.points[static_cast<size_t>(i)][1];
    }
    const Eigen::VectorXd force = PredictFriction(truth, LogSamples(at)).force;
    for (size_t i = 0; i < band.points.size(); ++i) {
      const double f = force[static_cast<Eigen::Index>(i)];
      held += band.interval95[i][0] <= f && f <= band.interval95[i][1];
      errors += std::pow(band.value[i] - f, 2);
      variances += std::pow(band.std[i], 2);
      ++all;
    }
  }
};

/// Bands of maps of 20 kernels over 40 logs.
Cover CoverOf(const Friction& truth, double colour) {
  Cover cover;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Trial trial =
        Identify(truth, "position-ridge", seed, colour, {{"kernels", "20"}, {"width", "1"}});
    if (trial.estimate.bands.size() == 1u) cover.Add(trial, truth);
  }
  return cover;
}

// the prior allows for a map as rough as its kernels; a smooth one is held more often than in 95 %,
// but by bands that are at most twice as wide as the errors
void ExpectTheTruthIsHeld(double colour) {
  const Friction truth = Truth(test::PositionLevel(1, 0.3));
  const Cover cover = CoverOf(truth, colour);
  ASSERT_EQ(cover.all, 40 * 40);
  EXPECT_GT(cover.held, 0.93 * cover.all);
  EXPECT_LT(cover.variances, 4 * cover.errors);
}

TEST(Bands, HoldTheTruthAsOftenAsTheySay) { ExpectTheTruthIsHeld(0); }

TEST(Bands, HoldItInColouredNoiseAsWell) { ExpectTheTruthIsHeld(0.9); }

// a wave as large as the noise at a place, 0.1 N.m over the root of 150 samples: the prior holds it at nothing
TEST(Bands, HoldAMapThatCanHardlyBeSeen) {
  const Cover cover = CoverOf(Truth(test::PositionLevel(1, 0.008)), 0);
  ASSERT_EQ(cover.all, 40 * 40);
  EXPECT_GT(cover.held, 0.93 * cover.all);
}

TEST(Bands, OfLawAndMapAreFarNarrowerThanTheConstantThatTheyShare) {
  const Trial trial = Identify(Truth(test::PositionLevel(1, 0.3)), "position-ridge", 1, 0,
                               {{"kernels", "20"}, {"width", "1"}});
  const MapBand& band = trial.estimate.bands[0];
  std::vector<double> deviations = band.std;
  std::ranges::sort(deviations);
  EXPECT_LT(deviations[deviations.size() / 2], 0.03);
  EXPECT_FALSE(trial.estimate.Find("coulomb")->interval95) << "the kernels can imitate it";
  EXPECT_TRUE(trial.estimate.Find("viscous")->interval95);
}

TEST(Bands, OfAMapThatIsAlikeBothWaysStandAlone) {
  FrictionMap even = test::PositionLevel(1, 0.3);
  even.factor = MapFactor::one;
  const Trial trial = Identify(Truth(even), "position-ridge", 2, 0,
                               {{"kernels", "20"}, {"width", "1"}, {"basis", "position"}});
  const MapBand& band = trial.estimate.bands[0];
  for (size_t i = 0; i < band.points.size(); ++i) {
    EXPECT_NEAR(band.value[i], 0.3 * std::sin(4 * band.points[i][0] + 0.5), 0.05);
  }
}

TEST(Bands, OfTwoMapsEachHoldTheWholeFriction) {
  const Trial trial = Identify(Truth(test::MotorRipple(2, 0.2)), "motor-ridge", 3, 0,
                               {{"width", "1"}, {"arm_kernels", "10"}});
  ASSERT_EQ(trial.estimate.bands.size(), 2u) << trial.estimate.message;
  const MapBand& arm = trial.estimate.bands[1];
  for (size_t i = 0; i < arm.points.size(); ++i) {
    // ripple averages out over the arm's places: law alone is left
    const double v = arm.points[i][1];
    EXPECT_NEAR(arm.value[i], 0.5 * v + 2 * Sign(v), 0.06);
  }
}

TEST(Holes, AHoleInALogHoldsTheTruthAndIsToldOf) {
  // a level that rises from 5 to 25 N.m over the travel; nothing is logged backwards from 0.5 to 1.5 rad
  Friction friction = test::Cold();
  friction.maps = {test::Sampled(MapQuantity::position, EvenAxis(-2.5, 2.5, 64),
                                 MapFactor::direction, [](double p) { return 4 * p; })};
  Measurements m =
      test::RecordFriction(friction, 0.05, test::Travel(16000, 0.05, 2.5, {0.2, 0.5, 0.9}), 0.3, 1);
  Selection selection = Prepare(m).constant_speed().selection;
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    if (m.velocity[i] < 0 && m.position[i] > 0.5 && m.position[i] < 1.5) selection.keep[i] = false;
  }
  const Estimate estimate =
      test::Fitted("position-ridge", Prepare(m, selection), {{"kernels", "20"}});
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  EXPECT_THAT(estimate.FullMessage(), HasSubstr("the map has no data at position"));
  EXPECT_THAT(estimate.FullMessage(), HasSubstr("backwards"));

  // in the middle of the hole: between the neighbours, and the interval holds the truth
  const MapBand& band = estimate.bands[0];
  bool looked = false;
  for (size_t i = 0; i < band.points.size(); ++i) {
    const double p = band.points[i][0], v = band.points[i][1];
    if (v > 0 || std::abs(p - 1) > 0.2) continue;
    const double truth = -(15 + 5 * std::abs(v) + 4 * p);
    EXPECT_NEAR(band.value[i], truth, 2) << p;
    EXPECT_LT(band.interval95[i][0], truth);
    EXPECT_GT(band.interval95[i][1], truth);
    EXPECT_GT(band.std[i], 2) << p;
    looked = true;
  }
  EXPECT_TRUE(looked);
}

}  // namespace
}  // namespace warmjoint
