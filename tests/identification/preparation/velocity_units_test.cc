// A velocity column in another unit than it is taken for is named by its unit, whatever the motion and the digits of the column.
#include <gmock/gmock.h>
#include <warmjoint/prepared_log.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using ::testing::AnyOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kTurn = 2 * std::numbers::pi;  // rad
constexpr double kDegree = kTurn / 360;         // rad

enum class MadeMotion { holds, two_speeds, ramps, sines };
enum class Digits { exact, whole, noisy };

/// A unit that a column is in, and what names it.
struct Other {
  std::string remedy{};
  double velocity = 1;  // of the column, a rad/s
  double position = 1;  // of the column, a rad
  double gear = 1;      // as it is given
  double whole = 1;     // step of a velocity of whole numbers, in its unit
};

const std::vector<Other> kOthers{
    {.remedy = "--unit velocity=deg/s", .velocity = 1 / kDegree},
    {.remedy = "--unit velocity=rpm", .velocity = 60 / kTurn},
    {.remedy = "--unit velocity=mrad/s", .velocity = 1000},
    {.remedy = "--unit velocity=turn/s", .velocity = 1 / kTurn, .whole = 0.01},
    {.remedy = "--scale velocity=0.02", .velocity = 50, .gear = 50},
    {.remedy = "--scale velocity=0.01", .velocity = 100, .gear = 100},
    {.remedy = "--unit position=deg", .position = 1 / kDegree, .whole = 0.01},
};

/// A motion in SI: speeds up to 1 rad/s at 20 Hz for two minutes. Positions are exact.
Measurements Move(MadeMotion motion, std::uint64_t seed) {
  constexpr Index n = 2400;
  constexpr double h = 0.05, until = 2;  // s
  RandomStream random({seed, 0}, Stream::motion);
  Measurements m;
  m.time = VectorXd::LinSpaced(n, 0, h * (n - 1));
  m.velocity = m.position = m.torque = VectorXd::Zero(n);
  double speed = 0, wanted = 0, last = 0;
  for (Index i = 0; i < n; ++i) {
    const double t = m.time[i];
    const auto hold = static_cast<int>(t / until);
    if (i % 40 == 0) {
      last = wanted;
      const double size =
          motion == MadeMotion::two_speeds ? (hold / 2 % 2 ? 0.3 : 0.6) : random.Uniform(0.1, 1);
      wanted = hold % 2 ? -size : size;
    }
    // holds with short accelerations, ramps from one speed to the next, or two waves that never repeat each other
    const double share = (t - until * hold) / until;
    if (motion == MadeMotion::holds || motion == MadeMotion::two_speeds) speed = wanted;
    if (motion == MadeMotion::ramps) speed = last + (wanted - last) * share;
    if (motion == MadeMotion::sines) speed = 0.6 * std::cos(0.7 * t) + 0.4 * std::cos(1.9 * t);
    m.velocity[i] = speed;
    if (i > 0) m.position[i] = m.position[i - 1] + h * (m.velocity[i - 1] + speed) / 2;
    m.torque[i] = 0.8 * speed + std::copysign(4.5, speed);
  }
  return m;
}

/// The motion as a log has it, with the noise of a drive: of the torque always, of the velocity where the digits are noisy.
Measurements Logged(MadeMotion motion, Digits digits, const Other& unit, std::uint64_t seed) {
  Measurements m = Move(motion, seed);
  RandomStream random({seed, 1}, Stream::test);
  for (double& torque : m.torque) torque += 0.1 * random.Normal();
  for (double& v : m.velocity) {
    if (digits == Digits::noisy) v += 0.03 * random.Normal();
    v *= unit.velocity;
    if (digits == Digits::whole) v = unit.whole * std::round(v / unit.whole);
  }
  m.position *= unit.position;
  m.gear = unit.gear;
  return m;
}

constexpr MadeMotion kMotions[]{MadeMotion::holds, MadeMotion::two_speeds, MadeMotion::ramps,
                                MadeMotion::sines};
constexpr Digits kDigits[]{Digits::exact, Digits::whole, Digits::noisy};

TEST(VelocityUnits, AreNamedWhateverMotionAndDigits) {
  for (const Other& unit : kOthers) {
    for (const MadeMotion motion : kMotions) {
      for (const Digits digits : kDigits) {
        for (const std::uint64_t seed : {1, 2, 3}) {
          EXPECT_THAT(Prepare(Logged(motion, digits, unit, seed)).faults(),
                      ElementsAre(HasSubstr(unit.remedy)))
              << "motion " << static_cast<int>(motion) << ", digits " << static_cast<int>(digits)
              << ", gear " << unit.gear << ", seed " << seed;
        }
      }
    }
  }
}

TEST(VelocityUnits, OfAMotorWhoseGearNobodyGivesAreNamedByTheirFactor) {
  for (const double gear : {50.0, 100.0}) {
    for (const MadeMotion motion : kMotions) {
      for (const Digits digits : kDigits) {
        const auto faults = Prepare(Logged(motion, digits, {.velocity = gear}, 1)).faults();
        ASSERT_EQ(faults.size(), 1u);
        const std::string option = "--scale velocity=";
        const std::size_t at = faults[0].find(option);
        ASSERT_NE(at, std::string::npos) << faults[0];
        // 2 %: the tolerance of the comparison
        EXPECT_NEAR(std::stod(faults[0].substr(at + option.size())) * gear, 1, 0.02);
      }
    }
  }
}

TEST(VelocityUnits, OfARightColumnAreNotDoubted) {
  for (const MadeMotion motion : kMotions) {
    for (const Digits digits : kDigits) {
      for (const double whole : {0.001, 0.01, 0.1}) {
        for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
          EXPECT_THAT(Prepare(Logged(motion, digits, {.whole = whole}, seed)).faults(), IsEmpty())
              << "motion " << static_cast<int>(motion) << ", digits " << static_cast<int>(digits)
              << ", step " << whole << ", seed " << seed;
        }
      }
    }
  }
}

TEST(VelocityUnits, AreNamedOfAJointThatStaysWithinATurn) {
  // half a turn to and fro; 2 s at a time, so that degrees pass half a turn between samples
  for (const double rate : {1.0, 5.0, 20.0}) {
    Measurements m;
    const auto n = static_cast<Index>(200 * rate);
    m.time = VectorXd::LinSpaced(n, 0, static_cast<double>(n - 1) / rate);
    m.position = 1.5 * (0.4 * m.time.array()).sin() * (0.03 * m.time.array()).cos();
    const VectorXd velocity = 0.6 * (0.4 * m.time.array()).cos() * (0.03 * m.time.array()).cos() -
                              0.045 * (0.4 * m.time.array()).sin() * (0.03 * m.time.array()).sin();
    m.torque = 0.8 * velocity.array() + 4.5 * velocity.array().sign();
    m.velocity = velocity / kDegree;
    EXPECT_THAT(Prepare(m).faults(), ElementsAre(HasSubstr("--unit velocity=deg/s"))) << rate;
    m.velocity = velocity;
    EXPECT_THAT(Prepare(m).faults(), IsEmpty()) << rate;
  }
}

TEST(VelocityUnits, StaleRowsAreNamedByTheirShare) {
  for (const MadeMotion motion : {MadeMotion::holds, MadeMotion::ramps, MadeMotion::sines}) {
    for (const auto& [of, share] : {std::pair(2, "50 %"), std::pair(3, "67 %")}) {
      Measurements m = Logged(motion, Digits::noisy, {}, 1);
      for (Index i = 0; i < m.size(); ++i) {
        if (i % of) m.velocity[i] = 0;
      }
      EXPECT_THAT(Prepare(m).faults(),
                  ElementsAre(AllOf(HasSubstr(share), HasSubstr("--map velocity="),
                                    Not(HasSubstr("--scale")))))
          << "motion " << static_cast<int>(motion);
    }
  }
}

}  // namespace
}  // namespace warmjoint
