#include "identification/preparation/log_faults.h"

#include <gmock/gmock.h>
#include <warmjoint/prepared_log.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "identification/preparation/select.h"
#include "models/foundation/random_stream.h"
#include "tests/support/vectors.h"

namespace warmjoint {
namespace {

using Eigen::Index;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Plan {
  double step = 1;            // s
  int speeds = 60;            // held for 20 s each, U(0.1, 1) rad/s, of alternating sign
  double torque_noise = 0.5;  // N.m
  double position_noise = 0;  // rad
  double velocity_noise = 0;  // rad/s
  double encoder = 0;         // rad, resolution of the position; 0: fine
  double torque_step = 0;     // N.m, resolution; 0: fine
  std::uint64_t seed = 1;
};

double Rounded(double value, double step) {
  return step > 0 ? step * std::round(value / step) : value;
}

/// A joint of 5 N.m.s/rad and 15 N.m that loses a third of that with a time constant of 300 s.
Measurements Log(const Plan& plan) {
  RandomStream random({plan.seed, 0}, Stream::test);
  const auto hold = static_cast<Index>(std::lround(20 / plan.step));
  Eigen::VectorXd velocity(plan.speeds * hold);
  for (Index i = 0; i < plan.speeds; ++i) {
    const double speed = random.Uniform(0.1, 1);
    velocity.segment(i * hold, hold).setConstant(i % 2 == 0 ? speed : -speed);
  }
  Measurements m = test::Record(plan.step, velocity, velocity);
  for (Index i = 0; i < m.size(); ++i) {
    const double level = 10 + 5 * std::exp(-m.time[i] / 300);
    const double torque = 5 * velocity[i] + std::copysign(level, velocity[i]);
    m.torque[i] = Rounded(torque + plan.torque_noise * random.Normal(), plan.torque_step);
    m.position[i] = Rounded(m.position[i] + plan.position_noise * random.Normal(), plan.encoder);
    m.velocity[i] += plan.velocity_noise * random.Normal();
  }
  return m;
}

std::vector<std::string> Faults(const Measurements& m, const Selection& selection) {
  std::vector<std::string> sentences;
  for (const LogFault& fault : FindFaults(m, selection)) sentences.push_back(fault.sentence);
  return sentences;
}
std::vector<std::string> Faults(const Measurements& m) { return Faults(m, SelectConstantSpeed(m)); }

/// A change of a good log, and what the one fault that is found then names; empty: none is found.
struct Change {
  std::function<void(Measurements&)> make;
  std::string named;
};

void ExpectFaults(const Plan& plan, const std::vector<Change>& changes) {
  for (size_t i = 0; i < changes.size(); ++i) {
    SCOPED_TRACE(std::to_string(i) + ": " + changes[i].named);
    Measurements m = Log(plan);
    changes[i].make(m);
    const std::vector<std::string> faults = Faults(m);
    if (changes[i].named.empty()) {
      EXPECT_THAT(faults, IsEmpty());
    } else {
      EXPECT_THAT(faults, ElementsAre(HasSubstr(changes[i].named)));
    }
  }
}

/// Holds the torque of `count` samples.
std::function<void(Measurements&)> Stuck(Index count) {
  return [count](Measurements& m) { m.torque.segment(405, count).setConstant(m.torque[405]); };
}

/// Torque of 0 in so many samples.
std::function<void(Measurements&)> Zeros(Index count) {
  return [count](Measurements& m) {
    for (Index i = 0; i < count; ++i) m.torque[100 + 130 * i] = 0;
  };
}

/// So many jumps of position and velocity, for one to three samples each. position: rad; velocity: rad/s
std::function<void(Measurements&)> Jumps(Index count, double position, double velocity) {
  return [=](Measurements& m) {
    for (Index k = 0; k < count; ++k) {
      const Index at = 105 + 140 * k, length = 1 + k % 3;
      const double sign = k % 2 == 0 ? 1 : -1;
      m.position.segment(at, length).array() += sign * position;
      m.velocity.segment(at, length).array() += sign * velocity;
    }
  };
}

TEST(FindFaults, NamesJumpsThatReturn) {
  ExpectFaults({}, {{Jumps(6, 800, 60), "come back 6 times, for 12 samples"},
                    {Jumps(2, 800, 60), "come back 2 times, for 3 samples"},
                    {Jumps(1, 800, 60), ""}});
}

TEST(FindFaults, NamesWhatIsWrongAndAllowsWhatIsBelowItsBound) {
  constexpr double pi = std::numbers::pi;
  ExpectFaults(
      {}, {// units and scales, by the positions
           {[](Measurements& m) { m.velocity *= 30 / pi; }, "--unit velocity=rpm"},
           {[](Measurements& m) { m.position *= 180 / pi; }, "--unit position=deg"},
           {[](Measurements& m) { m.time *= 1000; }, "--unit time=ms"},
           {[](Measurements& m) { m.gear = 101, m.velocity *= 101; }, "--scale velocity=0.0099"},
           {[](Measurements& m) { m.velocity *= 1.1; }, "velocity is 1.1 times"},
           {[](Measurements& m) { m.velocity *= 1.01; }, ""},
           {[](Measurements& m) { m.velocity *= -1; }, "wrong sign"},
           // torque
           {[](Measurements& m) { m.torque = -m.torque; }, "--scale torque=-1"},
           {[](Measurements& m) { m.torque = m.torque.cwiseMin(14).cwiseMax(-14); }, "at 14 N.m"},
           {[](Measurements& m) { m.torque = m.torque.cwiseMax(-14); }, "at -14 N.m"},
           {Stuck(30), "30 samples from 405 to 434 s"},
           {Stuck(19), ""},
           {Zeros(5), "0 in 5 moving samples"},
           {Zeros(4), ""},
           {[](Measurements& m) { m.torque[333] = -1e4; }, "-1e+04 N.m at 333 s"},
           {[](Measurements& m) { m.torque[333] = -500; }, ""}});
  // without noise while the speed changes
  ExpectFaults({.torque_noise = 0}, {{Stuck(30), "stuck"}});
}

TEST(FindFaults, HoldsNoiseAndResolutionAgainstNobody) {
  for (const double step : {0.001, 0.01, 0.1, 1.0}) {
    for (const double encoder : {0.0, 2 * std::numbers::pi / 4096, 0.1, 1.0}) {
      const Measurements m = Log({.step = step,
                                  .speeds = step < 0.01 ? 4 : 60,
                                  .position_noise = encoder,
                                  .velocity_noise = step < 0.1 ? 0.05 : 0.0,
                                  .encoder = encoder});
      EXPECT_THAT(Faults(m), IsEmpty()) << step << " s, " << encoder << " rad";
    }
  }
}

TEST(FindFaults, AllowsASensorThatHidesTurnsBetweenSamples) {
  Measurements m = Log({});
  m.velocity *= 10;
  for (double& p : m.position) p = std::remainder(10 * p, 2 * std::numbers::pi);
  EXPECT_THAT(Faults(m), IsEmpty());
}

TEST(FindFaults, TellsNothingOfAVelocityWherePositionsAreMostlyNoise) {
  // positions of all but three segments stray by a tenth of their way
  Measurements m = Log({});
  m.velocity *= 0.6;
  EXPECT_THAT(Faults(m), ElementsAre(HasSubstr("one of the two is off")));
  RandomStream random({3, 1}, Stream::test);
  const auto selection = SelectConstantSpeed(m);
  for (size_t k = 3; k < selection.segments.size(); ++k) {
    const Segment& one = selection.segments[k];
    const double way = m.position[one.end - 1] - m.position[one.begin];
    for (Index i = one.begin; i < one.end; ++i) m.position[i] += 0.1 * way * random.Normal();
  }
  EXPECT_THAT(Faults(m, selection), IsEmpty());
}

TEST(FindFaults, TellsADelayAndCoarseStepsFromAScale) {
  Measurements m = Log({.step = 0.02, .speeds = 20});
  for (Index i = m.size() - 1; i > 0; --i)
    m.velocity[i] += 0.9 * (m.velocity[i] - m.velocity[i - 1]);
  EXPECT_THAT(Faults(m), IsEmpty()) << "overshoots for a sample";
  m = Log({.step = 0.02, .speeds = 20, .velocity_noise = 0.03});
  for (double& v : m.velocity) v = 0.1 * std::trunc(v / 0.1);
  EXPECT_THAT(Faults(m), IsEmpty()) << "steps";
  m = Log({.step = 0.02, .speeds = 20});
  for (Index i = 0; i < m.size(); ++i) m.position[i] = m.position[i / 7 * 7];
  EXPECT_THAT(Faults(m), IsEmpty()) << "stale positions";
}

TEST(FindFaults, FindsTheRangeAfterWhichAPositionStartsAgain) {
  Measurements m = Log({.step = 0.1});
  const Selection selection = SelectConstantSpeed(m);
  for (double& p : m.position) p -= 2.5 * std::floor(p / 2.5);
  EXPECT_THAT(Faults(m, selection), testing::Contains(HasSubstr("--wrap 2.5")));
}

TEST(FindFaults, CallsNeitherStepsNorSimulationsClipped) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const double step : {0.02, 0.1, 0.5, 1.0, 5.0}) {
      EXPECT_THAT(Faults(Log({.torque_step = step, .seed = seed})), IsEmpty()) << step;
    }
    EXPECT_THAT(Faults(Log({.torque_noise = 0, .seed = seed})), IsEmpty());
    EXPECT_THAT(Faults(Log({.torque_noise = 1e-9, .seed = seed})), IsEmpty());
  }

  // cold, without noise, and the highest speed for much longer than any other
  Measurements m = Log({.torque_noise = 0});
  m.velocity.tail(200).setConstant(2);
  m.torque = 5 * m.velocity.array() + 15 * m.velocity.array().sign();
  m = test::Record(1, m.velocity, m.torque);
  EXPECT_THAT(Faults(m), IsEmpty());
}

TEST(FindFaults, AllowsTorqueThatIsHeldBetweenItsReadings) {
  Measurements m = Log({.step = 0.01, .speeds = 10});
  for (Index i = 0; i < m.size(); ++i) m.torque[i] = m.torque[i / 40 * 40];
  EXPECT_THAT(Faults(m), IsEmpty());
}

TEST(FindFaults, AllowsZerosWhereTorqueIsNearZero) {
  for (const double step : {0.5, 5.0, 10.0}) {
    const Measurements m = Log({.torque_noise = 15, .torque_step = step});
    ASSERT_GE((m.torque.array() == 0).count(), 5);
    EXPECT_THAT(Faults(m), IsEmpty()) << step;
  }
}

TEST(CheckRecording, TellsTheFaults) {
  Measurements m = Log({});
  EXPECT_THAT(CheckRecording(m).faults, IsEmpty());
  m.velocity *= 1.1;
  EXPECT_THAT(CheckRecording(m).faults, ElementsAre(HasSubstr("velocity is 1.1 times")));
}

}  // namespace
}  // namespace warmjoint
