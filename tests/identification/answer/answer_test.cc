// Answers of others that are judged, and answers to several recordings.
#include <gmock/gmock.h>
#include <warmjoint/prepared_log.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "identification/answer/check_estimate.h"
#include "identification/answer/identify.h"
#include "identification/forward/log_trajectory.h"
#include "identification/forward/thermal_filter.h"
#include "identification/holdout/hold_out.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/warming/initial_energy.h"
#include "tests/support/judging.h"

namespace warmjoint {
namespace {

/// An estimate of another program: a friction, and a coulomb with an interval.
Estimate From(const Friction& friction, double half_width) {
  Estimate estimate;
  estimate.identifier = "other";
  estimate.friction = friction;
  const double coulomb = friction.parameters.at("coulomb");
  estimate.parameters = {
      {"viscous", friction.parameters.at("viscous"), "N.m.s/rad", {}, {}},
      {"coulomb", coulomb, "N.m", half_width / 2, {{coulomb - half_width, coulomb + half_width}}}};
  return estimate;
}

TEST(CheckEstimate, FindsWhatAnotherProgramLeftOut) {
  // no warming on a log that warms
  Estimate estimate = From(test::Cold(), 0.1);
  CheckEstimate(Prepare(test::RecordHour(test::TableOne(), 1)), {}, estimate);
  EXPECT_EQ(estimate.status, Status::inadequate_model);
  EXPECT_FALSE(estimate.friction);
  EXPECT_FALSE(estimate.Find("coulomb")->interval95);
  EXPECT_EQ(estimate.Find("coulomb")->value, 15);
}

TEST(CheckEstimate, LetsNumbersPassThatAreCloseToTheTruth) {
  // one per cent is below what matters
  Friction close = test::Cold();
  close.parameters["coulomb"] = 15.1;
  Estimate estimate = From(close, 0.1);
  CheckEstimate(Prepare(test::RecordHour(test::Cold(), 1)), {}, estimate);
  EXPECT_EQ(estimate.status, Status::ok) << estimate.message;
  EXPECT_TRUE(estimate.friction);
  EXPECT_TRUE(test::Asked(estimate, "direction").made);
}

TEST(CheckEstimate, GivesTheFrictionOfTheNumbersThatItMoves) {
  // torque in steps of 2 N.m, which its noise of 0.5 N.m does not even out
  Measurements m = test::RecordHour(test::Cold(), 1);
  for (double& torque : m.torque) torque = 2 * std::round(torque / 2);
  Estimate estimate = test::Fitted("nominal-ls", m);
  const double before = estimate.Find("coulomb")->value;
  CheckEstimate(Prepare(m), {}, estimate);
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  EXPECT_NE(estimate.Find("coulomb")->value, before);
  EXPECT_EQ(estimate.friction->parameters.at("coulomb"), estimate.Find("coulomb")->value);
}

TEST(FitAndCheck, TakesNoPatternOfTheHoldsForSettling) {
  // half a sine over each hold of 20 s, always with the motion or against it: it looks settled about its extreme. None is
  // confidently wrong, more than three standard errors beyond an end: 1 + 3 / 1.96 half widths
  for (const double sign : {-1, 1}) {
    for (const double phase : {0.0, 0.1, 0.2, 0.3}) {
      Measurements m = test::RecordHour(test::TableOne(), 3);
      m.torque.array() += sign * (std::numbers::pi * m.time.array() / 20 + phase).sin();
      const Estimate estimate = test::Answer("energy-ml", m);
      if (estimate.status != Status::ok) continue;
      const auto& interval = *estimate.Find("coulomb")->interval95;
      const double half = (interval[1] - interval[0]) / 2;
      EXPECT_NEAR((interval[0] + interval[1]) / 2, 15, 2.5 * half) << sign << " " << phase;
    }
  }
}

TEST(FrictionAtSpeeds, HoldsTheTruthColdAndWarm) {
  const Friction truth = test::TableOne();
  const Law& law = *FindLaw(truth.law);
  const std::vector<double> values = LawValues(truth);
  int held = 0, of = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Measurements m = test::RecordHour(truth, seed);
    const Estimate estimate = test::Answer("energy-ml", m);
    ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
    double warmest = 0;
    for (const double energy : AlongMotion(truth).Predict(TrajectoryOf(LogSamples(m))).energy) {
      if (std::abs(energy) > std::abs(warmest)) warmest = energy;
    }
    // speeds of each direction, two or three where they are well apart, cold and warm
    ASSERT_GE(estimate.friction_at_speeds.size(), 8u);
    for (const FrictionAtSpeed& one : estimate.friction_at_speeds) {
      const double cold = std::copysign(law.force(one.speed, values.data()), 1);
      const double value = cold + (*one.energy == 0 ? 0 : warmest);
      held += one.interval95[0] <= value && value <= one.interval95[1];
      ++of;
      EXPECT_LT(one.std, 0.02 * value);
    }
  }
  // 95 %, of figures of which those of one log miss together
  EXPECT_GE(held, 0.85 * of);
}

TEST(FrictionAtSpeeds, IsAllThatALogOfOneSpeedTells) {
  Eigen::VectorXd velocity(600);
  for (Eigen::Index i = 0; i < velocity.size(); ++i) velocity[i] = i / 20 % 2 == 0 ? 0.5 : -0.5;
  const Measurements m = test::RecordFriction(test::Cold(), 1, velocity, 0.5, 1);
  const Estimate estimate = test::Answer("nominal-ls", m, {{"law", "coulomb"}});
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  EXPECT_FALSE(estimate.Find("coulomb")->interval95);
  EXPECT_THAT(estimate.FullMessage(), testing::HasSubstr("one speed each way"));
  ASSERT_EQ(estimate.friction_at_speeds.size(), 2u);
  for (const FrictionAtSpeed& one : estimate.friction_at_speeds) {
    EXPECT_NEAR(one.value, 15 + 0.5 * 5, 4 * one.std);
  }
}

TEST(FrictionAtSpeeds, RefusesFrictionThatIsNotKnown) {
  // friction of 0.02 N.m beneath noise of 0.5 N.m
  Friction none = test::Cold();
  none.parameters = {{"viscous", 0.01}, {"coulomb", 0.02}};
  const Estimate estimate = test::Answer(
      "nominal-ls", test::RecordFriction(none, 1, test::AlternatingSpeeds(600, 3), 0.5, 3));
  EXPECT_NE(estimate.status, Status::ok);
}

TEST(CheckEstimate, SaysWhyNothingWasExamined) {
  Estimate estimate = From(test::Cold(), 0.1);
  estimate.friction.reset();
  CheckEstimate(Prepare(test::RecordHour(test::Cold(), 1)), {}, estimate);
  EXPECT_EQ(estimate.status, Status::ok);
  ASSERT_FALSE(estimate.diagnostics.empty());
  for (const Diagnostic& one : estimate.diagnostics) {
    EXPECT_FALSE(one.made);
    EXPECT_EQ(one.reason, "the fit gives no friction");
  }
}

/// Three mornings of the joint of Table I, half an hour each.
PreparedLog Mornings(double noise) {
  std::vector<Measurements> recordings;
  for (std::uint64_t day = 1; day <= 3; ++day) {
    recordings.push_back(
        test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(1800, day), noise, day));
  }
  return Prepare(recordings);
}

TEST(SeveralRecordings, EnergyMlFindsTheTruthWithoutNoise) {
  const Estimate estimate = test::Fitted("energy-ml", Mornings(0));
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  EXPECT_NEAR(estimate.Find("viscous")->value, 5, 1e-6);
  EXPECT_NEAR(estimate.Find("coulomb")->value, 15, 1e-6);
  EXPECT_NEAR(estimate.Find("thermal_gain")->value, -3, 1e-6);
  EXPECT_NEAR(estimate.Find("thermal_time_constant")->value, 600, 1e-3);
  EXPECT_LT(estimate.metrics->rmse, 1e-6);
}

TEST(SeveralRecordings, EnergyMlHoldsTheTruthInItsIntervals) {
  const Estimate estimate = test::Fitted("energy-ml", Mornings(0.5));
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  // three standard deviations of four parameters: beyond by chance once in a hundred recordings
  test::ExpectTold(estimate, test::TruthOf(test::TableOne()), 3);
}

/// The same mornings, of which each begins at an energy of its own, N.m.
PreparedLog Beginning(const std::vector<double>& energies, double noise) {
  std::vector<Measurements> recordings;
  for (const double energy : energies) {
    const std::uint64_t day = recordings.size() + 1;
    const Eigen::VectorXd velocity = test::AlternatingSpeeds(1800, day);
    Measurements m = test::RecordFriction(test::TableOne(), 1, velocity, noise, day);
    ThermalStart start;
    start.energy = energy;
    m.torque += PredictFriction(test::TableOne(), LogSamples(m), start).force -
                PredictFriction(test::TableOne(), LogSamples(m)).force;
    recordings.push_back(std::move(m));
  }
  return Prepare(recordings);
}

const std::vector<std::string> kStarts{"initial_energy", "initial_energy_2", "initial_energy_3"};

TEST(SeveralRecordings, EachHasAStartOfItsOwn) {
  const std::vector<double> energies{-1, -4, -2.5};
  const PreparedLog log = Beginning(energies, 0);
  const Estimate estimate = test::Fitted("energy-ml", log, {{"initial_energy", "estimated"}});
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  EXPECT_NEAR(estimate.Find("thermal_time_constant")->value, 600, 1e-3);
  for (size_t i = 0; i < energies.size(); ++i) {
    EXPECT_NEAR(estimate.Find(kStarts[i])->value, energies[i], 1e-6) << kStarts[i];
  }
  // whoever predicts the log begins each recording there, too
  const LogSamples& m = log.constant_speed().measurements;
  const Prediction again = PredictFriction(*estimate.friction, m, StartOf(estimate, m));
  EXPECT_LT((again.force - m.torque).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(SeveralRecordings, StartsLieInTheirIntervals) {
  const std::vector<double> energies{0, -4, -2.5};
  const Estimate estimate =
      test::Fitted("energy-ml", Beginning(energies, 0.5), {{"initial_energy", "estimated"}});
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  for (size_t i = 0; i < energies.size(); ++i) {
    const EstimatedParameter& found = *estimate.Find(kStarts[i]);
    EXPECT_NEAR(found.value, energies[i], 3 * *found.std) << kStarts[i];
  }
}

TEST(SeveralRecordings, OneWithoutSamplesHasNoStart) {
  // nothing of the second is left: the third keeps its number
  const PreparedLog log = Beginning({-1, -4, -2.5}, 0);
  const LogView& view = log.constant_speed();
  Selection others = view.selection;
  others.keep.segment(1800, 1800) = false;
  const Identifier& identifier = FindIdentifier("energy-ml");
  const Options options = identifier.options.Read({{"initial_energy", "estimated"}});
  const IdentifierInput input{log, options, {}};
  const Fit fit = identifier.fit(input.With(others));
  ASSERT_FALSE(fit.refusal) << fit.refusal->message;
  EXPECT_NEAR(fit.parameters[*fit.RowOf(Role::start)].value, -1, 1e-6);
  EXPECT_EQ(fit.parameters[*fit.RowOf(Role::jump)].name, "initial_energy_3");
  EXPECT_NEAR(fit.parameters[*fit.RowOf(Role::jump)].value, -2.5, 1e-6);
}

TEST(SeveralRecordings, OneThatBeganWarmIsSeen) {
  const Identifier& identifier = FindIdentifier("energy-ml");
  const auto rejected = [&](const std::vector<double>& energies) {
    const IdentifierInput input{Beginning(energies, 0.2), identifier.options, {}};
    return test::Asked(IdentifyAndCheck(identifier, input), "initial_energy").rejected;
  };
  EXPECT_FALSE(rejected({0, 0, 0}));
  EXPECT_TRUE(rejected({0, 0, -4}));
}

TEST(SeveralRecordings, EnergyAlsStartsColdWithEach) {
  // as one recording the joint would be some 3 N.m too cold at each start
  const Estimate estimate =
      test::Fitted("energy-als", Mornings(0.1), {{"iterations", "500"}}, {11, 3});
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  // its own 1 % to the fixed point, and the noise
  EXPECT_NEAR(estimate.Find("thermal_time_constant")->value, 600, 0.02 * 600);
  EXPECT_NEAR(estimate.metrics->rmse, 0.1, 0.01);
}

TEST(SeveralRecordings, KalmanAsksForOne) {
  const Estimate estimate = test::Fitted("kalman", Mornings(0.1));
  EXPECT_EQ(estimate.status, Status::bad_data);
  EXPECT_THAT(estimate.message, testing::HasSubstr("give one"));
}

TEST(SeveralRecordings, AreHeldOutFromTheEnd) {
  const Identifier& identifier = FindIdentifier("energy-ml");
  const Options options = identifier.options.Read({});
  const auto held = HoldOut(identifier, {Mornings(0.5), options, {}}, 1.0 / 3).metrics;
  ASSERT_TRUE(held);
  EXPECT_NEAR(held->n, 1800, 1);
  // noise of 0.5 N.m, known from 1800 samples to 0.5 / sqrt(3600), three times, and the parameters
  EXPECT_NEAR(held->rmse, 0.5, 3 * 0.5 / 60 + 0.01);
}

TEST(SeveralRecordings, NoneIsHeldOutWhoseStartIsNotKnown) {
  const Identifier& identifier = FindIdentifier("energy-ml");
  const Options options = identifier.options.Read({{"initial_energy", "estimated"}});
  const IdentifierInput input{Beginning({0, -4, -2.5, -4}, 0.5), options, {}};
  // of four recordings the last half of the third, and not the fourth
  const auto held = HoldOut(identifier, input, 0.375).metrics;
  ASSERT_TRUE(held);
  EXPECT_NEAR(held->n, 900, 1);
  EXPECT_NEAR(held->rmse, 0.5, 3 * 0.5 / std::sqrt(2 * 900) + 0.02);
}

/// Three recordings of a joint, each with a weight of its own, N.m.
Estimate UnderWeights(const std::vector<double>& weights) {
  std::vector<Measurements> logs;
  for (const double weight : weights) {
    logs.push_back(test::RecordHour(test::Cold(), 1 + logs.size()));
    logs.back().torque.array() += weight * logs.back().position.array().sin();
  }
  Identifier identifier = FindIdentifier("nominal-ls");
  identifier.options = identifier.options.Read({{"gravity", "sincos"}});
  return IdentifyAndCheck(identifier, {Prepare(std::move(logs)), identifier.options, {}}, {});
}

TEST(SeveralRecordings, NameThatTheirWeightsDiffer) {
  const Estimate apart = UnderWeights({2, 8, 14});
  EXPECT_TRUE(test::Asked(apart, "recording").rejected) << apart.message;
  EXPECT_THAT(apart.FullMessage(), ::testing::HasSubstr("each recording by itself"));
  const Estimate alike = UnderWeights({8, 8, 8});
  EXPECT_EQ(alike.status, Status::ok) << alike.message;
  EXPECT_FALSE(test::Asked(alike, "recording").rejected);
}

}  // namespace
}  // namespace warmjoint
