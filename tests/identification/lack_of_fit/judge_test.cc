#include <fmt/format.h>
#include <gmock/gmock.h>
#include <warmjoint/prepared_log.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "identification/answer/identify.h"
#include "identification/identifiers/identifier_list.h"
#include "identification/preparation/select.h"
#include "identification/sentences/friction.h"
#include "models/friction/sign.h"
#include "tests/support/judging.h"

namespace warmjoint {
namespace {

using test::Answer;
using test::Asked;
using test::Cold;
using test::CountAlarms;
using test::CountRejected;
using test::kFew;
using test::kInadequate;
using test::kNearlyAll;
using test::RecordHour;
using ::testing::HasSubstr;

/// AR(1) noise with the given coefficient and a standard deviation of 0.5 N.m.
Measurements Coloured(const Friction& friction, std::uint64_t seed, double a) {
  Measurements m = RecordHour(friction, seed, 0);
  test::AddNoise(m, 0.5, a, seed);
  return m;
}

/// Travels to and fro over 5 rad with a speed drawn for each way; h = 0.2 s, 20 min.
Measurements Travel(std::uint64_t seed) {
  RandomStream random({seed, 0}, Stream::motion);
  Eigen::VectorXd velocity(6000);
  double position = 0, speed = random.Uniform(0.1, 1);
  for (double& v : velocity) {
    v = speed;
    position += 0.2 * v;
    if (std::abs(position) < 2.5 || position * v < 0) continue;
    speed = std::copysign(random.Uniform(0.1, 1), -v);
  }
  return test::RecordFriction(Cold(), 0.2, velocity, 0.5, seed);
}

/// The level rises by 0.06 N.m at half time: of 0.4 % of the friction the tests hint more often than they reject.
Measurements Step(std::uint64_t seed) {
  Measurements m = RecordHour(test::TableOne(), seed);
  const Eigen::Index half = m.size() / 2;
  m.torque.tail(half) += 0.06 * m.velocity.tail(half).array().sign().matrix();
  return m;
}

TEST(Judge, LetsIntervalsHoldWhatATestHintsAt) {
  int hints = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Estimate estimate = Answer("energy-ml", Step(seed));
    if (estimate.status != Status::ok) continue;
    for (const Diagnostic& one : estimate.diagnostics) {
      if (!one.made || one.rejected || one.p > 0.01) continue;
      ++hints;
      for (const auto& [name, move] : one.moves) {
        if (name != "coulomb" && name != "viscous") continue;
        const EstimatedParameter& parameter = *estimate.Find(name);
        if (!parameter.interval95) continue;
        // no farther than all of the effect in a tenth of the log changes the friction, at 1 rad/s or slower
        const double reach = std::min(std::abs(move), std::sqrt(10.0) * one.effect);
        const auto [lower, upper] = *parameter.interval95;
        EXPECT_LE(lower, parameter.value - reach) << one.test;
        EXPECT_GE(upper, parameter.value + reach) << one.test;
      }
    }
  }
  EXPECT_GE(hints, 5);
}

TEST(Judge, FindsThatAJointWarmsUp) {
  const auto warm = [](std::uint64_t seed) { return RecordHour(test::TableOne(), seed); };
  EXPECT_GE(CountRejected("nominal-ls", "energy", warm), kNearlyAll);
  EXPECT_THAT(Answer("nominal-ls", warm(1)).FullMessage(), HasSubstr("try --identifier energy-ml"));
}

TEST(Judge, FindsTheRippleOfTheMotor) {
  // a level that ripples by 1 N.m twice a turn, with gear 100
  const auto ripple = [](std::uint64_t seed) {
    Measurements m = Travel(seed);
    m.gear = 100;
    for (Eigen::Index i = 0; i < m.size(); ++i) {
      m.torque[i] += Sign(m.velocity[i]) * std::sin(200 * m.position[i] + 0.4);
    }
    return m;
  };
  EXPECT_GE(CountRejected("nominal-ls", "motor_angle", ripple), kNearlyAll);
  EXPECT_THAT(Answer("nominal-ls", ripple(1)).FullMessage(), HasSubstr("period 3.14 rad"));
}

TEST(Judge, FindsRippleAlongTheJoint) {
  const auto ripple = [](std::uint64_t seed) {
    Measurements m = Travel(seed);
    m.torque.array() += 4 * (20 * m.position.array()).sin();
    return m;
  };
  const Estimate estimate = Answer("nominal-ls", ripple(1));
  EXPECT_EQ(estimate.status, kInadequate);
  // 2 pi / 20; the frequencies that are tried are half a cycle of 16 along the travel apart
  EXPECT_THAT(estimate.FullMessage(), HasSubstr("depends on position (period 0.31"));
  EXPECT_THAT(estimate.FullMessage(), HasSubstr("alike in both directions"));
}

TEST(Judge, FindsTheStribeckCurve) {
  const auto curve = [](std::uint64_t seed) {
    Measurements m = RecordHour(Cold(), seed);
    for (Eigen::Index i = 0; i < m.size(); ++i) {
      const double v = m.velocity[i];
      m.torque[i] += std::copysign(5 * std::exp(-std::pow(v / 0.2, 2)), v);
    }
    return m;
  };
  EXPECT_GE(CountRejected("nominal-ls", "speed", curve), kNearlyAll);
}

TEST(Judge, MeasuresHarmBesideTheFrictionAlone) {
  // a curve over speed beside 17 N.m of friction, and beside gravity that is six times as large
  for (const double gravity : {0.0, 100.0}) {
    for (const double curve : {1.5, 14.0}) {
      Measurements m = Travel(1);
      m.torque.array() += gravity * m.position.array().sin();
      for (Eigen::Index i = 0; i < m.size(); ++i) {
        m.torque[i] -=
            std::copysign(curve * std::exp(-std::pow(m.velocity[i] / 0.3, 2)), m.velocity[i]);
      }
      const Estimate estimate = Answer("nominal-ls", m, {{"gravity", "sincos"}});
      EXPECT_TRUE(Asked(estimate, "speed").rejected) << gravity << " " << curve;
      EXPECT_EQ(estimate.status, curve > 10 ? kInadequate : Status::ok) << estimate.message;
    }
  }
}

TEST(Judge, LetsTheRightModelPass) {
  const auto warm = [](std::uint64_t seed) { return RecordHour(test::TableOne(), seed); };
  const auto cold = [](std::uint64_t seed) { return RecordHour(Cold(), seed); };
  EXPECT_LE(CountAlarms("energy-ml", warm), kFew);
  EXPECT_LE(CountAlarms("nominal-ls", cold), kFew);
  EXPECT_LE(CountAlarms("nominal-ls", Travel), kFew);
}

TEST(Judge, DoesNotTakeColouredNoiseForStructure) {
  const auto warm = [](std::uint64_t seed) { return Coloured(test::TableOne(), seed, 0.9); };
  const auto cold = [](std::uint64_t seed) { return Coloured(Cold(), seed, 0.9); };
  EXPECT_LE(CountAlarms("energy-ml", warm), kFew);
  EXPECT_LE(CountAlarms("nominal-ls", cold), kFew);
}

TEST(Judge, DoesNotTakeWhatIsPeriodicInTimeForRipple) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Measurements m = Travel(seed);
    m.gear = 100;
    m.torque.array() += 2 * (2 * M_PI / 7 * m.time.array()).sin();
    EXPECT_FALSE(Asked(Answer("nominal-ls", m), "motor_angle").rejected) << seed;
  }
}

TEST(Judge, TakesBackEverythingButTheValues) {
  const Measurements warm = RecordHour(test::TableOne(), 1);
  const Identifier& identifier = FindIdentifier("nominal-ls");
  const IdentifierInput input{Prepare(warm, SelectMoving(warm)), identifier.options, {}};
  const Estimate before = IdentifyUnchecked(identifier, input);
  const Estimate judged = IdentifyAndCheck(identifier, input);
  EXPECT_FALSE(judged.friction);
  EXPECT_EQ(judged.Find("coulomb")->value, before.Find("coulomb")->value);
  EXPECT_FALSE(judged.Find("coulomb")->std || judged.Find("coulomb")->interval95);
  EXPECT_TRUE(judged.metrics);

  // who insists sees the numbers, beside the verdict
  const Estimate forced =
      ReportAnswer(identifier, input, FitAndCheck(identifier, input), RefusedNumbers::show);
  EXPECT_EQ(forced.status, kInadequate);
  EXPECT_THAT(forced.FullMessage(), HasSubstr("void"));
  EXPECT_EQ(forced.Find("coulomb")->interval95, before.Find("coulomb")->interval95);
  EXPECT_TRUE(forced.friction);
}

TEST(Judge, WarnsOfSmallStructureAndLetsIntervalsReachAsFar) {
  // 0.05 N.m rms of friction that falls with speed: 0.3 %, but certain in 3600 samples
  Measurements m = RecordHour(Cold(), 1, 0.1);
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    const double v = m.velocity[i];
    m.torque[i] += std::copysign(0.4 * std::exp(-std::pow(v / 0.2, 2)), v);
  }
  const PreparedLog log = Prepare(m, SelectMoving(m));
  const Estimate before = test::Fitted("nominal-ls", log), judged = Answer("nominal-ls", log);
  ASSERT_EQ(judged.status, Status::ok) << judged.message;
  ASSERT_EQ(judged.warnings.size(), 1u);
  EXPECT_THAT(judged.warnings[0], HasSubstr("the residual depends on speed"));
  const auto& narrow = *before.Find("coulomb")->interval95;
  const auto& wide = *judged.Find("coulomb")->interval95;
  EXPECT_GT(narrow[0], 15);  // the true level
  EXPECT_LT(wide[0], 15);
  EXPECT_GT(wide[1], 15);

  // of what the half width is made: noise as without the verdict, and what was found
  double noise = 0, found = 0;
  for (const HalfWidthPart& part : judged.half_widths) {
    if (part.parameter == "coulomb") (part.by == "findings" ? found : noise) += part.half_width;
  }
  EXPECT_NEAR(noise, 0.5 * (narrow[1] - narrow[0]), 1e-9);
  EXPECT_NEAR(noise + found, 0.5 * (wide[1] - wide[0]), 1e-9);
}

TEST(Judge, GivesThePartsOfEveryHalfWidth) {
  const Estimate estimate = Answer("nominal-ls", RecordHour(Cold(), 1));
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  std::map<std::string, double> sum;
  for (const HalfWidthPart& part : estimate.half_widths) sum[part.parameter] += part.half_width;
  for (const EstimatedParameter& one : estimate.parameters) {
    const auto& [lower, upper] = *one.interval95;
    EXPECT_NEAR(sum[one.name], 0.5 * (upper - lower), 1e-9) << one.name;
  }
  EXPECT_EQ(sum.size(), estimate.parameters.size() + estimate.friction_at_speeds.size());
}

TEST(Judge, SaysTheLargestChangeOfTheFrictionAtASpeed) {
  // of a log with small structure: what stands in the half width of a speed, as a share of its friction
  Measurements m = RecordHour(Cold(), 1, 0.1);
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    const double v = m.velocity[i];
    m.torque[i] += std::copysign(0.4 * std::exp(-std::pow(v / 0.2, 2)), v);
  }
  const Estimate estimate = Answer("nominal-ls", m);
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  double largest = 0;
  for (const FrictionAtSpeed& one : estimate.friction_at_speeds) {
    for (const HalfWidthPart& part : estimate.half_widths) {
      if (part.parameter != NameOfFriction(one) || part.by != "findings") continue;
      largest = std::max(largest, part.half_width / std::abs(one.value));
    }
  }
  EXPECT_GT(largest, 0);
  EXPECT_THAT(estimate.warnings.at(0),
              HasSubstr(fmt::format("by up to {:.2g} % at", 100 * largest)));
}

TEST(FaultyLog, EndsAsBadDataForEveryIdentifier) {
  // revolutions a minute
  Measurements m = test::RecordHour(test::TableOne(), 1);
  m.velocity *= 60 / (2 * std::numbers::pi);
  const PreparedLog log = Prepare(m, SelectConstantSpeed(m));
  for (const char* name : {"energy-ml", "nominal-ls", "lugre", "kalman"}) {
    const Estimate estimate = Answer(name, log);
    EXPECT_EQ(estimate.status, Status::bad_data) << name;
    EXPECT_THAT(estimate.message, HasSubstr("--unit velocity=rpm")) << name;
    EXPECT_FALSE(estimate.friction) << name;
    for (const EstimatedParameter& one : estimate.parameters) EXPECT_FALSE(one.interval95) << name;
  }
}

}  // namespace
}  // namespace warmjoint
