#include "identification/fields/fit_fields.h"

#include <gtest/gtest.h>
#include <warmjoint/friction_model.h>

#include <cmath>
#include <map>
#include <string>

#include "tests/support/judging.h"
#include "tests/support/refusal.h"
#include "tests/support/travelling.h"

namespace warmjoint {
namespace {

const std::map<std::string, std::string> kFields{
    {"fields", "auto"}, {"gravity", "sincos"}, {"motion", "any"}};

/// Motion of any kind of a cold joint with a ripple of its friction over the place, N.m.
Measurements Rippled(double ripple, std::uint64_t seed) {
  Measurements m = test::Excited(test::Cold(), 4000, seed);
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    const double sign = (m.velocity[i] > 0) - (m.velocity[i] < 0);
    m.torque[i] += ripple * sign * std::sin(7 * m.position[i]);
  }
  return m;
}

TEST(FitWithFields, HoldsFrictionUnderARipple) {
  // by seeds of the noise; the truth is the mean over the places seen
  int held = 0, figures = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Measurements m = Rippled(1.5, seed);
    const Estimate estimate = test::Answer("nominal-ls", m, kFields);
    const double mean = 1.5 * (7 * m.position.array()).sin().mean();
    ASSERT_EQ(estimate.status, Status::ok) << estimate.FullMessage();
    for (const FrictionAtSpeed& one : estimate.friction_at_speeds) {
      const double truth = test::Cold().parameters.at("coulomb") + mean +
                           test::Cold().parameters.at("viscous") * std::abs(one.speed);
      ++figures;
      held += one.interval95[0] <= truth && truth <= one.interval95[1];
      EXPECT_LT(one.std, 0.03 * truth);
    }
  }
  EXPECT_GE(held, 0.9 * figures) << figures;
}

TEST(FitWithFields, GivesTheRippleAsAMap) {
  const Estimate estimate = test::Answer("nominal-ls", Rippled(1.5, 1), kFields);
  ASSERT_TRUE(estimate.friction) << estimate.FullMessage();
  Friction found = *estimate.friction;
  ASSERT_FALSE(found.maps.empty());
  ASSERT_EQ(found.maps.size(), estimate.bands.size());
  // along places at one speed, forwards: the law's level and the ripple
  Measurements along = test::Excited(test::Cold(), 100, 1);
  along.velocity.setConstant(0.6);
  along.position = Eigen::VectorXd::LinSpaced(100, -0.6, 0.6);
  const Eigen::VectorXd force = PredictFriction(found, LogSamples(along)).force;
  for (Eigen::Index i = 0; i < 100; ++i) {
    const double truth = test::Cold().parameters.at("coulomb") +
                         0.6 * test::Cold().parameters.at("viscous") +
                         1.5 * std::sin(7 * along.position[i]);
    EXPECT_NEAR(force[i], truth, 0.5) << along.position[i];
  }
}

TEST(FitWithFields, GivesAConstantTorqueAsAMap) {
  // as much in both directions, though no torque over the place is there
  constexpr double offset = 4;
  Measurements m = Rippled(0, 2);
  m.torque.array() += offset;
  const Estimate estimate = test::Answer("nominal-ls", m, kFields);
  ASSERT_TRUE(estimate.friction) << estimate.FullMessage();
  Measurements at = test::Excited(test::Cold(), 2, 1);
  at.velocity << 0.5, -0.5;
  at.position.setZero();
  const Eigen::VectorXd force = PredictFriction(*estimate.friction, LogSamples(at)).force;
  const double cosine = estimate.gravity ? estimate.gravity->Torque(at.position)[0] : 0;
  EXPECT_NEAR(force.mean() + cosine, offset + test::kCosine, 0.3);
}

TEST(FitWithFields, HoldsAFrictionThatFallsWithSpeed) {
  Measurements m = test::Excited(test::Cold(), 4000, 1);
  const double level = test::Cold().parameters.at("coulomb"),
               slope = test::Cold().parameters.at("viscous"),
               fall = .2 * level / m.velocity.cwiseAbs().maxCoeff();
  m.torque -= (slope + fall) * m.velocity;
  const Estimate estimate = test::Answer("nominal-ls", m, kFields);
  ASSERT_EQ(estimate.status, Status::ok) << estimate.FullMessage();
  EXPECT_EQ(estimate.Find("viscous")->value, 0);
  EXPECT_FALSE(estimate.Find("viscous")->interval95);
  ASSERT_GE(estimate.friction_at_speeds.size(), 3U);
  for (const FrictionAtSpeed& one : estimate.friction_at_speeds) {
    const double speed = std::abs(one.speed), truth = level - fall * speed;
    EXPECT_NEAR(one.value, truth, 4 * one.std) << speed;
    EXPECT_LT(one.std, .03 * truth);
    // the file brakes as the answer says
    Measurements at = test::Excited(test::Cold(), 2, 1);
    at.velocity.setConstant(speed);
    at.position.setZero();
    const double force = PredictFriction(*estimate.friction, LogSamples(at)).force[0];
    EXPECT_NEAR(force, truth, .03 * truth) << speed;
  }
}

TEST(FitWithFields, FollowsALoggedTemperature) {
  // friction that falls by .2 N.m a kelvin, of surroundings that warm and cool the joint, not its losses
  constexpr double slope = -0.2;
  Measurements m = test::Excited(test::Cold(), 4000, 4);
  const Eigen::ArrayXd time = m.time.array() - m.time[0];
  const Eigen::ArrayXd rise = 8 * (15 * time / time[m.size() - 1]).sin();
  m.torque.array() += slope * rise * m.velocity.array().sign();
  m.temperature = (25 + rise).matrix();
  const Estimate estimate = test::Answer("nominal-ls", m, kFields);
  ASSERT_EQ(estimate.status, Status::ok) << estimate.FullMessage();
  ASSERT_FALSE(estimate.friction_at_speeds.empty());
  for (const FrictionAtSpeed& one : estimate.friction_at_speeds) {
    // at the mean temperature
    const double truth = test::Cold().parameters.at("coulomb") + slope * rise.mean() +
                         test::Cold().parameters.at("viscous") * std::abs(one.speed);
    EXPECT_NEAR(one.value, truth, 4 * one.std);
    EXPECT_LT(one.std, 0.01 * truth);
  }
}

TEST(FitWithFields, IsWithoutARippleAboutLeastSquares) {
  const Estimate with = test::Answer("nominal-ls", Rippled(0, 3), kFields);
  auto options = kFields;
  options["fields"] = "none";
  const Estimate without = test::Answer("nominal-ls", Rippled(0, 3), options);
  for (const char* const name : {"viscous", "coulomb", "inertia"}) {
    const EstimatedParameter &one = *with.Find(name), &other = *without.Find(name);
    EXPECT_NEAR(one.value, other.value, 2 * *one.std) << name;
    EXPECT_LT(*one.std, 3 * *other.std) << name;
  }
}

TEST(FitWithFields, WarmsUpUnderARipple) {
  Friction joint = test::TableOne();
  joint.maps = {test::PositionLevel(3, 0.7)};
  Measurements m = test::RecordFriction(joint, 1, test::Travel(6000, 1, 3, {0.15, 0.3, 0.6}), 0, 1);
  m.position.array() -= 3;
  m.torque = PredictFriction(joint, LogSamples(m)).force;
  test::AddNoise(m, 0.5, 0, 7);
  const Estimate estimate = test::Answer("energy-ml", m, {{"fields", "auto"}});
  test::ExpectTold(estimate, test::TruthOf(test::TableOne()), 3.5, 0.2);
}

TEST(FitWithFields, LeavesAnExactTorqueAlone) {
  const Measurements exact =
      test::RecordFriction(test::Cold(), 1, test::AlternatingSpeeds(3600, 1), 0, 1);
  const Estimate estimate = test::Answer("nominal-ls", exact, {{"fields", "auto"}});
  EXPECT_NEAR(estimate.Find("coulomb")->value, test::Cold().parameters.at("coulomb"), 1e-9);
  EXPECT_TRUE(estimate.friction->maps.empty());
}

TEST(FitWithFields, ReadsItsOption) {
  const auto options = [](const std::string& text) {
    return FindIdentifier("nominal-ls").options.Read({{"fields", text}}).Get<FieldOption>().fields;
  };
  EXPECT_EQ(options("auto"), FieldSet::All());
  EXPECT_TRUE(options("none").kinds.empty());
  EXPECT_EQ(options("q,d").kinds, (std::vector{FieldKind::place_torque, FieldKind::time_friction}));
  for (const char* const wrong : {"x", "q,,r", "q,q", "", "qr"}) {
    EXPECT_THROW(options(wrong), BadInput) << wrong;
  }
}

}  // namespace
}  // namespace warmjoint
