// A joint that moves as one does in degrees is asked for its unit, and no other.
#include <gmock/gmock.h>
#include <warmjoint/recording.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "models/foundation/random_stream.h"

namespace warmjoint {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

constexpr double kDegrees = 180 / std::numbers::pi;  // in a rad

/// Positions of 20 samples a second, and torque against the motion.
struct Motion {
  std::vector<double> time, position, velocity, torque;

  void Add(double speed, double seconds) {
    for (int i = 0; i < 20 * seconds; ++i) {
      const double before = position.empty() ? 0 : position.back() + velocity.back() / 20;
      time.push_back(static_cast<double>(time.size()) / 20);
      position.push_back(before);
      velocity.push_back(speed);
      torque.push_back(speed + std::copysign(1, speed));
    }
  }
};

ReadSettings WithUnits(const ColumnTexts& unit) {
  ReadSettings settings;
  settings.unit = unit;
  return settings;
}

/// The same factor on positions and velocity.
ReadSettings Scaled(double factor) {
  ReadSettings settings;
  settings.scale = {{"position", factor}, {"velocity", factor}};
  return settings;
}

/// To and fro by `stroke` rad at `speed` rad/s.
Motion ToAndFro(double stroke, double speed) {
  Motion motion;
  for (int i = 0; i < 20; ++i) motion.Add(i % 2 ? -speed : speed, stroke / speed);
  return motion;
}

/// Whether the unit is asked for. times: of the position and the velocity
bool Asks(Motion motion, double times, const ReadSettings& settings = {},
          bool has_position = true) {
  for (auto* values : {&motion.position, &motion.velocity}) {
    for (double& value : *values) value *= times;
  }
  std::map<std::string, std::vector<double>> columns{
      {"time", motion.time}, {"velocity", motion.velocity}, {"torque", motion.torque}};
  if (has_position) columns["position"] = motion.position;
  const Measurements log = MakeRecording(columns, settings);
  const bool asks = std::ranges::any_of(log.doubts, [](const std::string& doubt) {
    return doubt.find("--unit position=deg") != std::string::npos;
  });
  // what is asked stands among what reading says
  if (asks) {
    EXPECT_THAT(log.notes, Contains(HasSubstr("--unit position=deg")));
  }
  return asks;
}

TEST(Angles, InDegreesThatNobodyNamesAreAskedFor) {
  EXPECT_TRUE(Asks(ToAndFro(2, 0.5), kDegrees)) << "far";
  EXPECT_TRUE(Asks(ToAndFro(1, 1.5), kDegrees)) << "fast";
  EXPECT_TRUE(Asks(ToAndFro(2, 1.5), kDegrees, {}, false)) << "without positions";
  EXPECT_TRUE(Asks(ToAndFro(2, 1.5), kDegrees, Scaled(-1)));
  EXPECT_FALSE(Asks(ToAndFro(2, 1.5), 1));
  EXPECT_FALSE(Asks(ToAndFro(2, 1.5), 1, {}, false));
}

TEST(Angles, WithAUnitAGearOrAFactorAreNotAskedFor) {
  EXPECT_FALSE(
      Asks(ToAndFro(2, 1.5), kDegrees, WithUnits({{"position", "deg"}, {"velocity", "deg/s"}})));
  EXPECT_FALSE(Asks(ToAndFro(2, 1.5), kDegrees, Scaled(0.01745)));
  ReadSettings motor, slide;
  motor.gear = 50;
  slide.joint = JointKind::linear;
  EXPECT_FALSE(Asks(ToAndFro(400, 100), 1, motor));
  EXPECT_FALSE(Asks(ToAndFro(2, 1.5), kDegrees, slide));
  // wheels and spindles
  Motion wheel;
  for (const double speed : {20.0, 50.0, 90.0}) wheel.Add(speed, 20);
  EXPECT_TRUE(Asks(wheel, 1));
  EXPECT_FALSE(Asks(wheel, 1, WithUnits({{"position", "rad"}})));
}

TEST(Angles, OfAJointThatDriftsFarInManyStrokesAreNotAskedFor) {
  RandomStream random({1, 0}, Stream::motion);
  for (int log = 0; log < 20; ++log) {
    Motion motion;
    for (int i = 0; i < 180; ++i) motion.Add((i % 2 ? -1 : 1.2) * random.Uniform(0.1, 1), 20);
    const auto [least, most] = std::ranges::minmax(motion.position);
    ASSERT_GT(most - least, 100);
    for (double& p : motion.position) p += 1e-3 * random.Normal();
    EXPECT_FALSE(Asks(motion, 1)) << log;
  }
}

}  // namespace
}  // namespace warmjoint
