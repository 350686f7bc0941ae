#include "identification/answer/settling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace warmjoint {
namespace {

constexpr Eigen::Index kSegments = 60, kHold = 100;  // samples each
constexpr double kStep = 0.05;                       // s

/// Holds that follow each other at once, of speeds in turn forwards and backwards.
struct Holds {
  Selection selection;
  Eigen::VectorXd time =
      Eigen::VectorXd::LinSpaced(kSegments * kHold, 0, kStep*(kSegments* kHold - 1));
  Eigen::VectorXd residual = Eigen::VectorXd::Zero(kSegments * kHold);

  /// of_hold: residual by the time since the begin of the hold, s, and its velocity, rad/s
  explicit Holds(const std::function<double(double, double)>& of_hold) {
    selection.keep.setConstant(time.size(), true);
    std::mt19937 engine(7);
    std::normal_distribution<double> noise(0, 0.1);
    const double speeds[] = {0.1, 1, 0.3};
    for (Eigen::Index k = 0; k < kSegments; ++k) {
      const double velocity = (k % 2 == 0 ? 1 : -1) * speeds[k % 3];
      selection.segments.push_back({k * kHold, (k + 1) * kHold, velocity});
      for (Eigen::Index i = 0; i < kHold; ++i) {
        residual[k * kHold + i] = of_hold(kStep * static_cast<double>(i), velocity) + noise(engine);
      }
    }
  }

  Settling Found() const { return SettlingTime(selection, time, residual); }
};

constexpr double kEnd = kStep * (kHold - 1);  // s, of a hold

double SignOf(double velocity) { return velocity > 0 ? 1 : -1; }

TEST(Settling, TakesAsLongAsTheTorqueFades) {
  // 1 N.m that fades to a third of the noise in 0.5 s
  const Holds holds([](double t, double v) { return SignOf(v) * std::exp(-t / 0.15); });
  EXPECT_GE(holds.Found().after, 0.4);
  EXPECT_LE(holds.Found().after, 1.2);
  EXPECT_EQ(holds.Found().before, 0);
  // without these samples it has settled
  Holds rest = holds;
  rest.selection = WithoutSettling(holds.selection, holds.time, holds.Found());
  Eigen::VectorXd kept(rest.selection.count());
  Eigen::Index n = 0;
  for (Eigen::Index i = 0; i < holds.time.size(); ++i) {
    if (rest.selection.keep[i]) kept[n++] = holds.residual[i];
  }
  EXPECT_EQ(SettlingTime(rest.selection, rest.time, kept).both(), 0);
  EXPECT_EQ(rest.selection.segments.front().begin, std::llround(holds.Found().after / kStep));
}

TEST(Settling, SeesWhatHasNoSign) {
  std::mt19937 engine(3);
  std::normal_distribution<double> ringing(0, 1);
  const Holds holds([&](double t, double) { return t < 0.12 ? ringing(engine) : 0; });
  EXPECT_GE(holds.Found().after, 0.12);
  EXPECT_LE(holds.Found().after, 0.5);
}

TEST(Settling, SeesWhatComesBeforeTheChange) {
  // the last sample holds part of what comes, far more than the first ones lack
  Holds holds(
      [](double t, double v) { return SignOf(v) * (t > kEnd - 0.01 ? -5 : std::exp(-t / 0.15)); });
  const double first = holds.Found().before;
  EXPECT_GE(first, 0.05);
  EXPECT_LE(first, 1.2);
}

TEST(Settling, IsNoneOfNoise) {
  EXPECT_EQ(Holds([](double, double) { return 0; }).Found().both(), 0);
}

TEST(Settling, IsNoneOfAPlace) {
  // a force, or a friction, near the places where the joint turns: at both ends of each hold
  const auto near_turns = [](double t) { return std::exp(-std::min(t, kEnd - t) / 0.2); };
  EXPECT_EQ(Holds([&](double t, double) { return near_turns(t); }).Found().both(), 0);
  EXPECT_EQ(Holds([&](double t, double v) { return SignOf(v) * near_turns(t); }).Found().both(), 0);
  EXPECT_EQ(
      Holds([&](double t, double v) { return SignOf(t - kEnd / 2) * SignOf(v) * near_turns(t); })
          .Found()
          .both(),
      0);
}

TEST(Settling, IsNoneOfWhatTakesAllOfAHold) {
  EXPECT_EQ(Holds([](double t, double v) { return SignOf(v) * std::exp(-t / 2); }).Found().both(),
            0);
}

}  // namespace
}  // namespace warmjoint
