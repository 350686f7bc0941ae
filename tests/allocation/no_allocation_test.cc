// A step of the plugin asks for no memory. This test has a program of its own, because it counts
// every malloc.
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "sim/model/friction_actuator.h"
#include "tests/sim/plugin/friction_models.h"

namespace {

std::atomic<long> allocations{0};

}  // namespace

extern "C" void* __libc_malloc(size_t size);

// what operator new calls
extern "C" void* malloc(size_t size) noexcept {
  ++allocations;
  return __libc_malloc(size);
}

namespace warmjoint {
namespace {

/// Friction with all its parts.
Friction Full() {
  Friction friction{"stribeck",
                    {{"viscous", 0.4},
                     {"coulomb", 3},
                     {"static", 4},
                     {"stribeck_velocity", 0.1},
                     {"stribeck_exponent", 2}},
                    Thermal{-0.3, 50}};
  friction.second_thermal = Thermal{-0.1, 5};
  friction.level_per_temperature = -0.1;
  friction.load_gain = 0.1;
  FrictionMap map{{{MapQuantity::motor_position, CircleAxis(2 * std::numbers::pi, 36)},
                   {MapQuantity::velocity, SpeedAxis(0.2, 2, 3)}},
                  KernelKind::normalised,
                  std::vector<double>(36 * 6, 0.1)};
  friction.maps = {map};
  return friction;
}

/// Allocations of a thousand steps of a swinging link.
long AllocationsOf(const std::string& section) {
  const test::Model m = test::MustCompile(test::LinkXml(section, R"(timestep="0.001")"));
  const test::Data d(mj_makeData(m.get()));
  mj_step(m.get(), d.get());
  const long before = allocations;
  for (int i = 0; i < 1000; ++i) {
    d->qfrc_applied[0] = 9 * std::sin(0.01 * i);
    mj_step(m.get(), d.get());
  }
  return allocations - before;
}

TEST(PluginStep, AsksForNoMemory) {
  const long before = allocations;
  double* volatile block = new double[100];
  delete[] block;
  ASSERT_GT(allocations.load(), before) << "the counter does not count";

  const std::string sections = FrictionSections({"hinge", Full()});
  EXPECT_EQ(AllocationsOf(sections.substr(sections.find("<actuator>"))), AllocationsOf(""));
}

}  // namespace
}  // namespace warmjoint
