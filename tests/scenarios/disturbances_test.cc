#include "scenarios/disturbances.h"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

namespace warmjoint {
namespace {

TEST(Disturbances, DifferWhereAnyOfThemDoes) {
  // one number of each member
  const std::vector<std::function<void(Disturbances&)>> changes{
      [](Disturbances& d) { d.outliers.fraction = 0.1; },
      [](Disturbances& d) { d.coloured_noise.deviation = 0.1; },
      [](Disturbances& d) { d.uneven_noise.of_speed = 0.1; },
      [](Disturbances& d) { d.periodic_torque.amplitude = 0.1; },
      [](Disturbances& d) { d.gravity.sine = 0.1; },
      [](Disturbances& d) { d.ambient_drift.amplitude = 0.1; },
      [](Disturbances& d) { d.ambient_temperature.amplitude = 0.1; },
      [](Disturbances& d) { d.load_change.load = 0.1; },
      [](Disturbances& d) { d.torque_lag.time_constant = 0.1; },
      [](Disturbances& d) { d.velocity_filter.time_constant = 0.1; },
      [](Disturbances& d) { d.stale_position.samples = 1; },
      [](Disturbances& d) { d.encoder.resolution = 0.1; },
      [](Disturbances& d) { d.hold_parity.level = 0.1; },
      [](Disturbances& d) { d.step_in_time.level = 0.1; },
      [](Disturbances& d) { d.run_in.level = 0.1; },
      [](Disturbances& d) { d.hidden.backlash.level = 0.1; },
      [](Disturbances& d) { d.faults.clock.factor = 1.1; },
      [](Disturbances& d) { d.without_velocity = true; },
      [](Disturbances& d) {
        d.second_heat = Thermal{-1, 60};
      },
  };
  EXPECT_EQ(Disturbances{}, Disturbances{});
  for (size_t i = 0; i < changes.size(); ++i) {
    Disturbances changed;
    changes[i](changed);
    EXPECT_FALSE(changed == Disturbances{}) << "member " << i;
    EXPECT_EQ(changed, changed) << "member " << i;
  }
}

}  // namespace
}  // namespace warmjoint
