#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "identification/forward/log_trajectory.h"
#include "tests/support/judging.h"
#include "tests/support/travelling.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;
using Texts = std::map<std::string, std::string>;

Estimate Identify(const Measurements& measurements, const Texts& given = {}, StartKey key = {}) {
  return test::Fitted("energy-als", measurements, given, key);
}

Measurements TableOneRecording(std::uint64_t seed, Eigen::Index rest = 0) {
  return test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(3600, seed, rest), 0.5,
                              seed);
}

TEST(EnergyAls, ReproducesTheGoldenFixedPoint) {
  const nlohmann::json& golden = test::Golden().at("dataset").at("joint_open");
  const Estimate estimate = Identify(test::GoldenRecording(), {{"iterations", "1000"},
                                                               {"start", "options"},
                                                               {"start_gain", "-1"},
                                                               {"start_time_constant", "300"}});
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  const auto check = [&](const char* name, const char* key) {
    const double expected = golden.at(key);
    // iterative optimiser: 1e-6 on parameters (golden/README)
    EXPECT_NEAR(estimate.Find(name)->value, expected, 1e-6 * std::abs(expected)) << name;
  };
  check("viscous", "kv");
  check("coulomb", "kc");
  check("thermal_gain", "kbar");
  check("thermal_time_constant", "tbar");
  check("thermal_gain_discrete", "ke");
  check("thermal_pole", "te");
}

/// The golden numbers count all 240 samples: the 8 at rest are all residual.
double RmseWithRests(const Measurements& m, const Metrics& fit, double rmse) {
  const double rests = (m.velocity.array() == 0).select(m.torque, 0).squaredNorm();
  return std::sqrt((rmse * rmse * fit.n + rests) / 240);
}

TEST(EnergyAls, FollowsTheGoldenIterations) {
  const Measurements recording = test::GoldenRecording();
  for (const char* key : {"alg1_start_a", "alg1_start_b"}) {
    const nlohmann::json& golden = test::Golden().at("dataset").at(key);
    const int last = golden.at("iters").back();
    const Estimate estimate = Identify(
        recording, {{"iterations", std::to_string(last)},
                    {"tolerance", "1e-15"},
                    {"start", "options"},
                    {"start_gain", fmt::format("{}", golden.at("kbar0").get<double>())},
                    {"start_time_constant", fmt::format("{}", golden.at("tbar0").get<double>())}});
    for (size_t row = 0; row < golden.at("iters").size(); ++row) {
      const TraceEntry& entry = estimate.trace.at(golden["iters"][row].get<size_t>());
      const std::map<std::string, double> found(entry.parameters.begin(), entry.parameters.end());
      const Eigen::VectorXd expected = test::ToVector(golden.at("kv_kc_ke_te")[row]);
      const char* const names[]{"viscous", "coulomb", "thermal_gain_discrete", "thermal_pole"};
      // iterative optimiser: 1e-6 on parameters, 1e-10 on cost (golden/README)
      for (Eigen::Index i = 0; i < 4; ++i) {
        EXPECT_NEAR(found.at(names[i]) / expected[i], 1, 1e-6)
            << key << ": " << names[i] << " after " << entry.iteration;
      }
      const double rmse = golden.at("rmse")[row];
      EXPECT_NEAR(RmseWithRests(recording, *estimate.metrics, entry.rmse), rmse, 1e-6 * rmse);
    }
  }
}

TEST(EnergyAls, SaysThatFiftyIterationsAreTooFewForSteadyMotion) {
  const Estimate estimate = Identify(TableOneRecording(2), {{"start", "random"}}, StartKey{{7, 2}});
  EXPECT_EQ(estimate.status, Status::not_converged);
  EXPECT_THAT(estimate.message, HasSubstr("stopped after 50 iterations"));
  // the numbers can be scored, but nothing says how good they are
  ASSERT_TRUE(estimate.Find("coulomb"));
  EXPECT_FALSE(estimate.Find("coulomb")->std);
  EXPECT_FALSE(estimate.friction);
}

TEST(EnergyAls, ExtrapolatesItsDistanceToTheEnd) {
  // the message's distance after 100 iterations is what 1000 more then move, to its two digits
  const Measurements recording = TableOneRecording(3);
  const Texts start{{"start", "options"}, {"start_gain", "-1"}, {"start_time_constant", "300"}};
  Texts hundred = start, many = start;
  hundred["iterations"] = "100";
  hundred["tolerance"] = "1e-9";
  many["iterations"] = "1500";
  const Estimate early = Identify(recording, hundred);
  const Estimate late = Identify(recording, many);
  double largest = 0;
  for (const char* name : {"viscous", "coulomb", "thermal_gain", "thermal_time_constant"}) {
    const double a = early.Find(name)->value, b = late.Find(name)->value;
    largest = std::max(largest, std::abs(a - b) / std::abs(a));
  }
  const size_t at = early.message.find("up to ") + 6;
  const double claimed = std::stod(early.message.substr(at)) / 100;
  EXPECT_NEAR(claimed, largest, 0.3 * largest);
}

TEST(EnergyAls, ConvergesInFiftyIterationsWhereRestsLetTheJointCool) {
  int near = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Estimate estimate =
        Identify(TableOneRecording(seed, 600), {{"start", "random"}}, StartKey{{1, seed}});
    const Eigen::Vector4d error{estimate.Find("viscous")->value / 5 - 1,
                                estimate.Find("coulomb")->value / 15 - 1,
                                estimate.Find("thermal_gain")->value / -3 - 1,
                                estimate.Find("thermal_time_constant")->value / 600 - 1};
    near += error.norm() < 0.05;
  }
  EXPECT_GE(near, 8);
}

TEST(EnergyAls, TracesTheStartAndEveryIteration) {
  const Estimate estimate = Identify(TableOneRecording(4), {{"iterations", "20"}});
  ASSERT_EQ(estimate.trace.size(), 21u);
  EXPECT_EQ(estimate.trace.front().iteration, 0);
  EXPECT_EQ(estimate.trace.back().iteration, 20);
  EXPECT_EQ(estimate.trace.back().parameters.size(), 6u);
  EXPECT_DOUBLE_EQ(estimate.trace.back().rmse, estimate.metrics->rmse);
  for (size_t i = 1; i < estimate.trace.size(); ++i) {
    EXPECT_LE(estimate.trace[i].rmse, estimate.trace[i - 1].rmse * (1 + 1e-12)) << i;
  }
}

TEST(EnergyAls, DrawsItsStartFromItsKeyAlone) {
  const Measurements recording = TableOneRecording(5);
  const Texts given{{"start", "random"}, {"iterations", "1"}};
  const auto first = Identify(recording, given, {7, 1}).trace[0].parameters;
  EXPECT_EQ(Identify(recording, given, {7, 1}).trace[0].parameters, first);
  EXPECT_NE(Identify(recording, given, StartKey{{7, 2}}).trace[0].parameters, first);
}

TEST(EnergyAls, RefusesAFitThatDrivesTheJoint) {
  // the level falls by 8 N.m, below what is needed at slow speeds: there the torque turns around
  const Eigen::VectorXd velocity = test::AlternatingSpeeds(1200, 7);
  Measurements m = test::Record(1, velocity, velocity);
  for (Eigen::Index i = 0; i < 1200; ++i) {
    const double level = 10 * std::abs(velocity[i]) + 5 - 8 * -std::expm1(-m.time[i] / 100);
    m.torque[i] = Sign(velocity[i]) * level;
  }
  const Estimate estimate =
      Identify(m, {{"start", "options"}, {"start_gain", "-3"}, {"iterations", "200"}});
  EXPECT_EQ(estimate.status, Status::inadequate_model) << estimate.message;
  EXPECT_THAT(estimate.message, HasSubstr("drives the joint"));
  EXPECT_TRUE(estimate.parameters.empty());
}

TEST(EnergyAls, FitsAMapOverPositionBesideTheLaw) {
  Friction truth{
      "viscous_coulomb", {{"viscous", 0.0527}, {"coulomb", 0.48}}, Thermal{-0.194, 180}, 0, 1};
  truth.maps = {test::PositionLevel(1.5, 0.06)};
  const Eigen::VectorXd motion = test::Travel(6000, 0.2, 1.5, {0.3, 0.6, 1, 1.5, 2});
  const Measurements m = test::RecordFriction(truth, 0.2, motion, 0.01, 11);
  const Texts given{{"position", "map"},
                    {"kernels", "30"},
                    {"width", "1"},
                    {"iterations", "500"},
                    {"start_gain", "-0.1"}};
  const Estimate estimate = Identify(m, given);
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  ASSERT_EQ(estimate.friction->maps.size(), 1u);
  EXPECT_NEAR(estimate.metrics->rmse, 0.01, 0.01 * 0.05);  // 1 / sqrt(2 n) is 0.9 %
  // energy-ml gives them with a deviation of 1.5 % (gain) and 1 % (time constant): 4 of these
  EXPECT_NEAR(estimate.Find("thermal_gain")->value, -0.194, 0.06 * 0.194);
  EXPECT_NEAR(estimate.Find("thermal_time_constant")->value, 180, 0.04 * 180);

  // the friction that it gives is the one that it fitted
  const Prediction prediction = PredictFriction(*estimate.friction, LogSamples(m));
  const double rmse = std::sqrt((m.torque - prediction.force).squaredNorm() / 6000);
  EXPECT_NEAR(rmse, 0.01, 0.01 * 0.1);
}

TEST(EnergyAls, RefusesAMapBesideGravity) {
  const Estimate estimate =
      Identify(TableOneRecording(1), {{"position", "map"}, {"gravity", "sincos"}});
  EXPECT_EQ(estimate.status, Status::bad_data);
  EXPECT_THAT(estimate.message, HasSubstr("leave one of them out"));
}

}  // namespace
}  // namespace warmjoint
