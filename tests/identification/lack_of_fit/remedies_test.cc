// Every remedy is tried on a log that provokes it: it must lead on, to a smaller error, and to an end.
#include <gmock/gmock.h>
#include <warmjoint/prepared_log.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include "identification/answer/identify.h"
#include "identification/holdout/hold_out.h"
#include "models/foundation/low_pass.h"
#include "models/recording/measurements.h"
#include "tests/support/bristle_recording.h"
#include "tests/support/judging.h"
#include "tests/support/travelling.h"

namespace warmjoint {
namespace {

using Options_ = std::map<std::string, std::string>;

/// What one command makes of a log.
struct Step {
  std::string identifier;
  Options_ given;
  Estimate estimate;
  std::optional<IdentifyCommand> remedy;
  double held_out = 0;  // RMSE, N.m

  std::string Name() const {
    std::string name = identifier;
    for (const auto& [key, value] : given) name += " " + key + "=" + value;
    return name;
  }
};

/// Refuses what changes the friction by a fiftieth, so that there is advice to follow.
constexpr LackOfFitSettings kStrict{.relevance = 0.02};

Step Take(const std::string& name, const Options_& given, const Measurements& m) {
  const Identifier& identifier = FindIdentifier(name);
  const IdentifierInput input{Prepare(m), identifier.options.Read(given), {}};
  const auto answer = FitAndCheck(identifier, input, kStrict);
  Step step{name, given, ReportAnswer(identifier, input, answer), {}, 0};
  for (const Cause& cause : answer.judged.causes) {
    if (cause.remedy) step.remedy = cause.remedy->command;
  }
  const auto held = HoldOut(identifier, input, 0.3).metrics;
  step.held_out = held ? held->rmse : kInfinity;
  return step;
}

/// Follows the advice until an answer is ok, and gives that.
void FollowAdvice(const std::string& identifier, const Measurements& m, Estimate& end) {
  Step step = Take(identifier, {}, m);
  ASSERT_EQ(step.estimate.status, Status::inadequate_model) << step.estimate.message;
  std::set<std::string> seen{step.Name()};
  for (int steps = 0; step.estimate.status != Status::ok; ++steps) {
    ASSERT_LT(steps, 4) << "the advice has no end: " << step.Name();
    ASSERT_TRUE(step.remedy) << step.Name() << ": " << step.estimate.FullMessage();
    const auto& [name, settings] = *step.remedy;
    Step other = Take(name, {settings.begin(), settings.end()}, m);
    ASSERT_TRUE(seen.insert(other.Name()).second) << "in a circle: " << other.Name();
    EXPECT_LT(other.held_out, step.held_out)
        << step.Name() << " says: " << step.estimate.FullMessage() << "\n and " << other.Name()
        << " says: " << other.estimate.FullMessage();
    step = std::move(other);
  }
  end = std::move(step.estimate);
}

void ExpectLeadsSomewhere(const std::string& identifier, const Measurements& m) {
  Estimate end;
  FollowAdvice(identifier, m, end);
}

/// The same to within four deviations of the truth of its law.
void ExpectLeadsTo(Friction truth, const std::string& identifier, const Measurements& m) {
  Estimate end;
  FollowAdvice(identifier, m, end);
  if (testing::Test::HasFatalFailure()) return;
  truth.thermal.reset();
  test::ExpectTold(end, test::TruthOf(truth), 4);
}

/// Travels over 5 rad at three speeds, h = 0.1 s, 20 min.
Measurements Travelling(const Friction& friction, std::uint64_t seed) {
  return test::RecordFriction(friction, 0.1, test::Travel(12000, 0.1, 2.5, {0.2, 0.5, 0.9}), 0.3,
                              seed);
}

Friction Warm(Friction joint) {
  joint.thermal = Thermal{-3, 600};
  return joint;
}

Measurements Offset(Measurements m) {
  m.torque.array() += 1.5;
  return m;
}

Measurements Slow(const Friction& friction) {
  return test::RecordFriction(friction, 1, test::SlowAndFast(3600, 1), 0.3, 1);
}

Measurements Rippled(Friction friction) {
  friction.maps = {test::PositionLevel(2.5, 1.5)};
  return Travelling(friction, 1);
}

/// 40 min at 10 Hz behind a lag of 0.4 s.
Measurements Lagging(const Friction& friction) {
  const Eigen::VectorXd velocity = test::Finer(test::AlternatingSpeeds(2400, 1), 10);
  Measurements m = test::RecordFriction(friction, 0.1, velocity, 0, 1);
  m.torque = LowPass(m.time, m.torque, 0.4);
  test::AddNoise(m, 0.3, 0, 1);
  return m;
}

Measurements Weighted(const Friction& friction) {
  Measurements m = Travelling(friction, 1);
  m.torque.array() += 4 * m.position.array().sin() + 2 * m.position.array().cos();
  return m;
}

/// What a log shows, an identifier that lacks it, and the log.
struct Lacking {
  std::string what;
  std::string identifier;
  std::function<Measurements()> log;
};

void PrintTo(const Lacking& lacking, std::ostream* stream) { *stream << lacking.what; }

class Remedy : public testing::TestWithParam<Lacking> {};

TEST_P(Remedy, LeadsOn) { ExpectLeadsSomewhere(GetParam().identifier, GetParam().log()); }

using test::Cold, test::TableOne, test::StribeckJoint;

INSTANTIATE_TEST_SUITE_P(
    For, Remedy,
    testing::Values(
        Lacking{"Warming", "nominal-ls", [] { return test::RecordHour(TableOne(), 1); }},
        Lacking{"Direction", "nominal-ls", [] { return Offset(test::RecordHour(Cold(), 1)); }},
        Lacking{"DirectionOfAJointThatWarms", "energy-ml",
                [] { return Offset(test::RecordHour(TableOne(), 1)); }},
        Lacking{"Speed", "nominal-ls", [] { return Slow(StribeckJoint()); }},
        Lacking{"SpeedOfAJointThatWarms", "stribeck", [] { return Slow(Warm(StribeckJoint())); }},
        Lacking{"Ripple", "nominal-ls", [] { return Rippled(Cold()); }},
        Lacking{"RippleOfAJointThatWarms", "energy-ml", [] { return Rippled(TableOne()); }},
        Lacking{"WarmingBesideRipple", "position-ridge", [] { return Rippled(TableOne()); }},
        Lacking{"Gravity", "nominal-ls", [] { return Weighted(Cold()); }},
        Lacking{"GravityOfAJointThatWarms", "energy-ml", [] { return Weighted(TableOne()); }}),
    [](const auto& lacking) { return lacking.param.what; });

TEST(Remedies, NameGravityBeforeAnythingElse) {
  for (const auto& [identifier, joint] :
       {std::pair{"nominal-ls", Cold()}, std::pair{"energy-ml", TableOne()}}) {
    Measurements m = Travelling(joint, 1);
    m.torque.array() += 25 * m.position.array().sin() + 8 * m.position.array().cos();
    const Estimate estimate = Take(identifier, {}, m).estimate;
    EXPECT_NE(estimate.status, Status::ok);
    const std::string& message = estimate.message;
    const auto gravity = message.find("--gravity sincos");
    EXPECT_NE(gravity, std::string::npos) << message;
    EXPECT_EQ(message.find("law=asymmetric"), std::string::npos) << message;
    EXPECT_LT(message.find("sine of the position"), message.find("time constant")) << message;
  }
}

TEST(Remedies, NeedsNoneForALagOfHoldsWhichSettle) {
  for (const auto& [identifier, joint] :
       {std::pair{"nominal-ls", Cold()}, std::pair{"energy-ml", TableOne()}}) {
    const Estimate settled = test::Answer(identifier, Lagging(joint));
    ASSERT_EQ(settled.status, Status::ok) << settled.message;
    EXPECT_TRUE(test::Holds(settled, "viscous", joint.parameters.at("viscous")));
    EXPECT_TRUE(test::Holds(settled, "coulomb", joint.parameters.at("coulomb")));
  }
}

TEST(Remedies, ForDirectionOfACurve) {
  const Friction cold = test::TwoLevelStribeckJoint();
  for (const Friction& joint : {cold, Warm(cold)}) {
    ExpectLeadsTo(joint, "stribeck", Slow(joint));
    ExpectLeadsTo(joint, joint.thermal ? "energy-ml" : "nominal-ls", Slow(joint));
  }
}

/// Table I at 1 Hz, with a part of its slope that follows the speed with 60 s. hold: s of each speed.
Measurements FollowingLate(Eigen::Index samples, Eigen::Index hold, std::uint64_t seed) {
  RandomStream random({seed, 1}, Stream::motion);
  Eigen::VectorXd velocity(samples);
  double v = -1;
  for (Eigen::Index i = 0; i < samples; ++i) {
    if (i % hold == 0) v = std::copysign(random.Uniform(0.1, 1), -v);
    velocity[i] = v;
  }
  Measurements m = test::RecordFriction(test::TableOne(), 1, velocity, 0.5, seed);
  double followed = std::abs(velocity[0]);
  for (Eigen::Index i = 0; i < samples; ++i) {
    const double speed = std::abs(velocity[i]);
    m.torque[i] += std::copysign(3, velocity[i]) * (followed - speed);
    followed += -std::expm1(-1 / 60.0) * (speed - followed);
  }
  return m;
}

TEST(Remedies, AgainstFrictionThatFollowsLate) {
  const Estimate hasty = test::Answer("energy-ml", FollowingLate(3600, 20, 1));
  ASSERT_TRUE(test::Asked(hasty, "speed_memory").rejected) << hasty.message;
  EXPECT_THAT(hasty.message, ::testing::HasSubstr("--trim"));

  // eight time constants a hold, three of which are left out at each end
  const Estimate patient = test::Answer(
      "energy-ml", Prepare(FollowingLate(10800, 480, 1), PrepareSettings{.trim = 180}));
  ASSERT_EQ(patient.status, Status::ok) << patient.message;
  EXPECT_TRUE(test::Holds(patient, "viscous", 5));
  EXPECT_TRUE(test::Holds(patient, "coulomb", 15));
}

/// The samples of one direction as a recording of its own. side: 1 or -1.
Measurements OneDirection(Measurements m, int side) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    if (side * m.velocity[i] > 0) rows.push_back(i);
  }
  ForEachColumn(m, [&](Eigen::VectorXd& column) { column = Eigen::VectorXd(column(rows)); });
  return m;
}

TEST(Remedies, AgainstASlopeOfEachDirectionOfACurve) {
  const Friction joint = test::TwoLevelStribeckJoint();
  Measurements m = Slow(joint);
  m.torque += 4 * m.velocity.cwiseMax(0);
  const Step together = Take("stribeck", {{"law", "asymmetric_stribeck"}}, m);
  EXPECT_EQ(together.estimate.status, Status::inadequate_model);
  EXPECT_THAT(
      together.estimate.FullMessage(),
      testing::HasSubstr("identify the samples of each direction as a recording of its own, "
                         "by --identifier stribeck"));
  for (const int side : {1, -1}) {
    const Step apart = Take("stribeck", {}, OneDirection(m, side));
    ASSERT_EQ(apart.estimate.status, Status::ok) << apart.estimate.FullMessage();
    EXPECT_LT(apart.held_out, together.held_out);
    const double level = side > 0 ? 15 : 12;
    const std::map<std::string, double> truth{{"viscous", side > 0 ? 9 : 5},
                                              {"coulomb", level},
                                              {"static", level + 5},
                                              {"stribeck_velocity", 0.05}};
    test::ExpectTold(apart.estimate, truth, 4);
  }
}

TEST(Remedies, AgainstDirectionOfABristle) {
  const Friction joint = test::TwoLevelLuGreJoint();
  const Measurements m =
      test::RecordBristle(joint, test::TurningMotion(60, 1), 60, 100, 0.3, 0.3, 1);
  ExpectLeadsTo(joint, "lugre", m);
}

/// Ripple of 1 N.m against the motion, every 1.3 rad.
Measurements WithRipple(Measurements m) {
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    m.torque[i] += Sign(m.velocity[i]) * std::sin(2 * std::numbers::pi / 1.3 * m.position[i]);
  }
  return m;
}

TEST(Remedies, AgainstMoreRippleThanAMapFollows) {
  // steps of a random walk over a hundred periods and more
  const Friction friction = test::Cold();
  const Measurements wide = WithRipple(test::RecordHour(friction, 1));
  ASSERT_GT(wide.position.maxCoeff() - wide.position.minCoeff(), 60 * 1.3);
  const Estimate estimate = Take("nominal-ls", {}, wide).estimate;
  EXPECT_EQ(estimate.status, Status::inadequate_model);
  EXPECT_TRUE(test::Asked(estimate, "position").rejected);
  EXPECT_THAT(estimate.message, ::testing::HasSubstr("record it within 55 rad"));

  // within that a map follows
  const Eigen::VectorXd velocity = test::Travel(12000, 0.1, 27, {0.2, 0.5, 0.9});
  ExpectLeadsSomewhere("nominal-ls",
                       WithRipple(test::RecordFriction(friction, 0.1, velocity, 0.3, 1)));
}

TEST(Remedies, AgainstRippleOfTheMotor) {
  Friction rippled = test::Cold();
  rippled.gear = 10;
  rippled.maps = {test::MotorRipple(2, 1.5)};
  const Eigen::VectorXd velocity = test::Travel(20000, 0.02, 2.5, {0.2, 0.5, 0.9});
  ExpectLeadsSomewhere("nominal-ls", test::RecordTravel(rippled, 0.02, velocity, 0, 0.3, 0, 1));
}

}  // namespace
}  // namespace warmjoint
