#include "identification/maps/holes.h"

#include <gmock/gmock.h>
#include <warmjoint/prepared_log.h>

#include "identification/answer/identify.h"
#include "identification/identifiers/identifier_list.h"
#include "tests/support/travelling.h"
#include "tests/support/warm_recording.h"

namespace warmjoint {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

FrictionMap FivePlaces() {
  return {{{MapQuantity::position, EvenAxis(0, 4, 5)}}, KernelKind::normalised, {}};
}

/// Samples at positions, and nothing else.
MapPoints At(const std::vector<double>& positions) {
  MapPoints points = MapPoints::Zero(static_cast<Eigen::Index>(positions.size()), 5);
  for (size_t i = 0; i < positions.size(); ++i)
    points(static_cast<Eigen::Index>(i), 0) = positions[i];
  return points;
}

/// The weights that a prior alone draws to, where the seen ones are given.
double DrawnTo(const std::vector<FrictionMap>& maps, const std::vector<bool>& unseen,
               Eigen::Index i, const Eigen::VectorXd& weights) {
  const Eigen::MatrixXd prior = PriorOf(maps, unseen, 1);
  return -(prior.row(i).dot(weights) - prior(i, i) * weights[i]) / prior(i, i);
}

TEST(Holes, AreKernelsThatHardlyAnySampleIsNearTo) {
  EXPECT_THAT(UnseenKernels({FivePlaces()}, At({0, 0.1, 0.2, 1, 1, 1.1, 2.1, 4, 4, 4})),
              ElementsAre(false, false, true, true, false));
}

TEST(Holes, AreDrawnToTheLineBetweenTheirNeighbours) {
  const Eigen::VectorXd weights = (Eigen::VectorXd(5) << 1, 2, 0, 4, 5).finished();
  EXPECT_NEAR(DrawnTo({FivePlaces()}, {false, false, true, false, false}, 2, weights), 3, 1e-12);

  // at an end to the one neighbour that there is
  EXPECT_NEAR(DrawnTo({FivePlaces()}, {true, false, false, false, false}, 0, weights), 2, 1e-12);
}

TEST(Holes, BetweenSeenKernelsAreHeldAsDataHoldThose) {
  const std::vector<bool> unseen{false, false, true, false, true};
  const Eigen::MatrixXd gram = Eigen::VectorXd({{40, 10, 0.1, 20, 0.2}}).asDiagonal();
  EXPECT_EQ(PullOver(gram, unseen, 0.01), 2000);
  EXPECT_EQ(PullOver(gram, unseen, 100), 1) << "a strong prior stays as it is";
  const Eigen::MatrixXd prior = PriorOf({FivePlaces()}, unseen, 2000);
  EXPECT_EQ(prior(2, 2), 2000);
  EXPECT_EQ(prior(4, 4), 1) << "at an end, where data reach into its cell";
  EXPECT_EQ(prior(0, 0), 1);
}

TEST(Holes, AreInDoubtByTheSpreadOfSeenWeights) {
  const FrictionMap map{{{MapQuantity::position, EvenAxis(0, 6, 7)}}, KernelKind::normalised, {}};
  // seen are 1, 3 and 5, whose standard deviation is 2
  const Eigen::VectorXd weights = Eigen::VectorXd({{0, 1, 3, 0, 0, 0, 5}});
  const std::vector<bool> unseen{true, false, false, true, true, true, false};
  // none for half a cell at the end, half beside a seen kernel
  EXPECT_THAT(DoubtOfHoles(map, 0, unseen, weights), ElementsAre(0, 0, 0, 1, 2, 1, 0));
}

TEST(Holes, OnACircleHaveNeighboursOnBothSides) {
  const FrictionMap turn{
      {{MapQuantity::motor_position, CircleAxis(4, 4)}}, KernelKind::normalised, {}};
  const Eigen::VectorXd weights = (Eigen::VectorXd(4) << 0, 2, 7, 4).finished();
  EXPECT_NEAR(DrawnTo({turn}, {true, false, false, false}, 0, weights), 3, 1e-12);
}

TEST(Holes, AreNamed) {
  EXPECT_THAT(NameHoles({FivePlaces()}, {false, false, true, true, false}, JointKind::linear),
              ElementsAre("position 1.5 to 3.5 m"));
}

TEST(Holes, AreNamedAtAnEndWhereTheyAreMoreThanAHalfCell) {
  EXPECT_THAT(NameHoles({FivePlaces()}, {true, false, false, false, false}, JointKind::linear),
              ElementsAre());
  EXPECT_THAT(NameHoles({FivePlaces()}, {false, false, false, true, true}, JointKind::linear),
              ElementsAre("position 2.5 to 4.5 m"));
}

TEST(Holes, AreNamedByWhateverTheMapIsOver) {
  const MapAxis turn{MapQuantity::motor_position, CircleAxis(4, 4)};
  const MapAxis speed{MapQuantity::velocity, SpeedAxis(1, 3, 2)};
  const MapAxis heat{MapQuantity::energy, EvenAxis(-1, 0, 2)};
  EXPECT_THAT(NameHoles({{{turn}, KernelKind::normalised, {}}}, {false, true, false, false},
                        JointKind::rotary),
              ElementsAre("motor_position 0.5 to 1.5 rad"));

  // speeds -3, -1, 1, 3: no sample at 3 forwards, whatever the angle
  std::vector<bool> unseen(16);
  for (size_t i = 3; i < 16; i += 4) unseen[i] = true;
  EXPECT_THAT(NameHoles({{{turn, speed}, KernelKind::normalised, {}}}, unseen, JointKind::rotary),
              ElementsAre("motor_position -0.5 to 3.5 rad forwards at 3"));

  // never seen cold at two angles
  EXPECT_THAT(NameHoles({{{turn, heat}, KernelKind::normalised, {}}},
                        {false, false, false, true, false, true, false, false}, JointKind::rotary),
              ElementsAre("motor_position 0.5 to 2.5 rad at energy 0 N.m"));
}

TEST(Holes, AHoleInALogHoldsTheTruthAndIsToldOf) {
  // a level that rises from 5 to 25 N.m over the travel; nothing is logged backwards from 0.5 to 1.5 rad
  Friction friction = test::TableOne();
  friction.thermal.reset();
  friction.maps = {test::Sampled(MapQuantity::position, EvenAxis(-2.5, 2.5, 64),
                                 MapFactor::direction, [](double p) { return 4 * p; })};
  Measurements m =
      test::RecordFriction(friction, 0.05, test::Travel(16000, 0.05, 2.5, {0.2, 0.5, 0.9}), 0.3, 1);
  const Identifier& identifier = FindIdentifier("position-ridge");
  Selection selection = Prepare(m).steady().selection;
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    if (m.velocity[i] < 0 && m.position[i] > 0.5 && m.position[i] < 1.5) selection.keep[i] = false;
  }
  const Estimate estimate = IdentifyUnjudged(
      identifier, {Prepare(m, selection), identifier.options.Read({{"kernels", "20"}}), {}});
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
