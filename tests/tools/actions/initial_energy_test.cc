// The heat that a joint starts with: cold, at the end of a recording, settled at a speed.
#include <gmock/gmock.h>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "tests/tools/scratch_directory.h"
#include "tools/actions/carried_heat.h"

namespace warmjoint {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

Friction Warm(bool two_stages) {
  Friction friction;
  friction.law = "viscous_coulomb";
  friction.parameters = {{"viscous", 5}, {"coulomb", 15}};
  friction.thermal = Thermal{-3, 600};
  if (two_stages) friction.second_thermal = Thermal{-1, 60};
  return friction;
}

class InitialEnergyOfAFile : public testing::Test {
 protected:
  std::string Estimate(const std::string& end) const {
    const std::string file = scratch.path() / "estimate.json";
    WriteWholeFile(file, R"({"status": "ok")" + end + "}");
    return file;
  }
  ScratchDirectory scratch;
};

TEST_F(InitialEnergyOfAFile, IsNoneWhereCold) {
  EXPECT_TRUE(InitialEnergy("cold", Warm(true), "no such file").empty());
}

TEST_F(InitialEnergyOfAFile, IsThatAtTheEndAsANumberOrWithItsInterval) {
  const std::string number = Estimate(R"(, "state_end": {"energy": -2.5})");
  EXPECT_THAT(InitialEnergy("end", Warm(false), number), ElementsAre(-2.5));
  const std::string interval = Estimate(
      R"(, "state_end": {"energy": {"value": -2.5, "std": 0.1, "interval95": [-2.7, -2.3]},
                         "second_energy": -0.5})");
  EXPECT_THAT(InitialEnergy("end", Warm(true), interval), ElementsAre(-2.5, -0.5));
}

TEST_F(InitialEnergyOfAFile, AtTheEndIsRefusedWhereTheFileHasNone) {
  const auto refuses = [&](const std::string& end, bool two_stages, const char* says) {
    const std::string file = Estimate(end);
    EXPECT_THAT([&] { InitialEnergy("end", Warm(two_stages), file); },
                ThrowsMessage<BadInput>(AllOf(HasSubstr("estimate.json"), HasSubstr(says))));
  };
  refuses("", false, "has no state_end");
  refuses(R"(, "state_end": {})", false, "no energy");
  refuses(R"(, "state_end": {"energy": -1})", true, "no second_energy");
  refuses(R"(, "state_end": {"energy": "hot"})", false, "state_end.energy");
}

TEST_F(InitialEnergyOfAFile, SettledIsTheClosedForm) {
  // E = k v F0 / (1 - k v), F0 = 5 v + 15
  const double v = 0.2, settled = -3 * v * (5 * v + 15) / (1 + 3 * v);
  const std::vector<double> energies = InitialEnergy("settled:0.2", Warm(false), "a file");
  ASSERT_EQ(energies.size(), 1U);
  EXPECT_NEAR(energies[0], settled, 1e-9);
  EXPECT_THAT([&] { InitialEnergy("settled:fast", Warm(false), "a file"); },
              ThrowsMessage<BadInput>(HasSubstr("rad/s")));
  EXPECT_THAT([&] { InitialEnergy("warm", Warm(false), "a file"); },
              ThrowsMessage<BadInput>(HasSubstr("cold, end or settled:SPEED")));
}

}  // namespace
}  // namespace warmjoint
