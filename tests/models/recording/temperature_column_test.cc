#include <gmock/gmock.h>

#include "models/foundation/bad_input.h"
#include "models/recording/csv.h"

namespace warmjoint {
namespace {

constexpr const char* kRows = "0,0,1,10,300\n1,1,1,11,301\n2,2,1,12,302\n";

Measurements Read(const std::string& name, const ReadSettings& layout = {}) {
  return ParseCsv("time,position,velocity,torque," + name + "\n" + kRows, "log.csv", layout);
}

TEST(TemperatureColumn, IsKnownByItsUnit) {
  for (const char* name : {"motor_degC", "case [degC]", "T (degC)", "oil/degC", "temp_K", "T_K",
                           "t [K]", "Temperature (K)"}) {
    EXPECT_TRUE(Read(name).temperature) << name;
  }
  for (const char* name : {"gain_K", "K", "degC", "torques", "", "T_", "BREAK"}) {
    EXPECT_FALSE(Read(name).temperature) << name;
  }
  const char* two =
      "time,position,velocity,torque,a_degC,b_degC\n0,0,1,10,3,3\n1,1,1,1,1,2\n2,2,1,1,1,1\n";
  EXPECT_FALSE(ParseCsv(two, "log.csv").temperature);
}

TEST(TemperatureColumn, IsReadInItsUnit) {
  const Measurements kelvin = Read("case_temp_K");
  ASSERT_TRUE(kelvin.temperature);
  EXPECT_NEAR((*kelvin.temperature)[0], 300 - 273.15, 1e-12);
  ASSERT_EQ(kelvin.notes.size(), 1u);
  EXPECT_EQ(kelvin.notes[0], "temperature from the column 'case_temp_K'");
  EXPECT_EQ((*Read("case_degC").temperature)[0], 300);

  // what is said counts, and what is left out is
  ReadSettings layout;
  layout.unit = {{"temperature", "K"}};
  EXPECT_NEAR((*Read("case_degC", layout).temperature)[0], 300 - 273.15, 1e-12);
  layout = {};
  layout.map = {{"temperature", ""}};
  EXPECT_FALSE(Read("case_degC", layout).temperature);
  EXPECT_FALSE(Read("speed_of_fan").temperature);
}

}  // namespace
}  // namespace warmjoint
