// Many simulations on several threads, by mjBatch and by threads of our own.
#include <gmock/gmock.h>

#include <cmath>
#include <thread>
#include <vector>

#include "tests/sim/plugin/friction_models.h"
#include "tests/sim/plugin/two_forms.h"

/// MuJoCo's library is not built with ThreadSanitizer, which therefore does not see how the pool of
/// mjBatch hands its states over to mj_setState. The plugin is not called from there.
extern "C" const char* __tsan_default_suppressions();
extern "C" const char* __tsan_default_suppressions() { return "race:mj_setState\n"; }

namespace warmjoint {
namespace {

using namespace test;

const Config kWarm{{"law", "stribeck"},
                   {"viscous", "0.5"},
                   {"coulomb", "3"},
                   {"static", "4"},
                   {"stribeck_velocity", "0.1"},
                   {"thermal_gain", "-0.3"},
                   {"thermal_time_constant", "10"}};
constexpr int kSimulations = 16;
constexpr int kHalf = 300;  // steps

Model Motor() {
  // ctrl: the friction's ambient, the motor's torque
  const std::string section = FrictionSection(kWarm);
  const size_t end = section.find("</actuator>");
  return MustCompile(LinkXml(section.substr(0, end) + R"(<motor joint="hinge"/></actuator>)",
                             R"(timestep="0.001" integrator="implicitfast")"));
}

/// The motor's torque in a step of a simulation, N.m.
double Torque(int sim, int step) { return 20 * std::sin(0.01 * step + sim); }

/// Controls of every simulation and step, [simulations x steps x 2].
std::vector<mjtNum> Controls(int first, int steps) {
  std::vector<mjtNum> controls;
  for (int sim = 0; sim < kSimulations; ++sim) {
    for (int i = first; i < first + steps; ++i) {
      controls.push_back(0);
      controls.push_back(Torque(sim, i));
    }
  }
  return controls;
}

std::vector<mjtNum> StateIn(const Data& d) { return {d->act[0], d->act[1], d->qpos[0]}; }

/// Where a simulation ends alone, by mj_step.
std::vector<mjtNum> EndOf(const Model& m, int sim, int steps) {
  const Data d(mj_makeData(m.get()));
  for (int i = 0; i < steps; ++i) {
    d->ctrl[1] = Torque(sim, i);
    mj_step(m.get(), d.get());
  }
  return StateIn(d);
}

TEST(PluginBatch, ContinuesBitForBitOnAnyNumberOfThreads) {
  const Model m = Motor();
  const int size = static_cast<int>(mj_stateSize(m.get(), mjSTATE_INTEGRATION));

  // one simulation after the other
  std::vector<std::vector<mjtNum>> expected;
  for (int sim = 0; sim < kSimulations; ++sim) {
    expected.push_back(EndOf(m, sim, 2 * kHalf));
    EXPECT_LT(expected.back()[1], -0.01) << "should be warm";
  }

  for (const int threads : {1, 4}) {
    // outlive the batch: ThreadSanitizer does not see how its pool says that it has read them
    const std::vector<mjtNum> halves[] = {Controls(0, kHalf), Controls(kHalf, kHalf)};
    const Batch batch = MakeBatch(m.get(), kSimulations, threads);
    ASSERT_EQ(mjb_nstate(batch.get()), size);
    ASSERT_EQ(mjb_reset(batch.get(), nullptr, kSimulations, nullptr, mjSTAGE_NONE), 0);

    // in two halves: the state between them is all that is kept
    for (const std::vector<mjtNum>& controls : halves) {
      ASSERT_EQ(mjb_rollout(batch.get(), nullptr, kSimulations, kHalf, controls.data(),
                            mjSTATE_CTRL, nullptr, 0),
                0);
    }
    const Data d(mj_makeData(m.get()));
    for (int sim = 0; sim < kSimulations; ++sim) {
      mjb_getData(batch.get(), sim, d.get());
      EXPECT_EQ(StateIn(d), expected[static_cast<size_t>(sim)]) << sim << ", " << threads;
    }
  }
}

TEST(PluginThreads, ShareAModelAndMoveAsAlone) {
  const Model m = Motor();
  constexpr int threads = 4;
  std::vector<std::vector<mjtNum>> together(threads);
  {
    std::vector<std::jthread> running;
    for (int k = 0; k < threads; ++k) {
      running.emplace_back([&, k] { together[static_cast<size_t>(k)] = EndOf(m, k, kHalf); });
    }
  }
  for (int k = 0; k < threads; ++k) {
    EXPECT_EQ(together[static_cast<size_t>(k)], EndOf(m, k, kHalf)) << k;
  }
}

}  // namespace
}  // namespace warmjoint
