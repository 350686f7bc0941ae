// Friction, residual and heat along a recording, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/recording.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "tests/tools/cli/in_a_folder.h"
#include "tests/tools/cli/little_files.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

/// The ripple of the recordings, N.m rms.
constexpr double kRipple = 0.2 / 1.41421356;

/// A file of a friction of 5 v + coulomb sign(v), N.m.
void WriteFriction(const std::filesystem::path& path, double coulomb,
                   const nlohmann::json& thermal = nullptr) {
  nlohmann::json friction{{"law", "viscous_coulomb"},
                          {"parameters", {{"viscous", 5}, {"coulomb", coulomb}}}};
  if (!thermal.is_null()) friction["thermal"] = thermal;
  WriteWholeFile(path, friction.dump());
}

class CompensateTest : public InAFolder {
 protected:
  void SetUp() override {
    WriteRecordingFile(at("log.csv"), 480);
    WriteFriction(at("friction.json"), 15);
    WriteFriction(at("weak.json"), 14);
    WriteFriction(at("warm.json"), 15, {{"thermal_gain", -0.5}, {"thermal_time_constant", 600}});
  }

  /// A column of a CSV, by its number.
  std::vector<double> Column(const std::string& name, std::size_t number) const {
    std::istringstream lines(File(name));
    std::string line;
    std::getline(lines, line);
    std::vector<double> values;
    while (std::getline(lines, line)) {
      std::istringstream fields(line);
      std::string field;
      for (std::size_t i = 0; i <= number; ++i) std::getline(fields, field, ',');
      values.push_back(field.empty() ? std::nan("") : std::stod(field));
    }
    return values;
  }
};

constexpr std::size_t kTorque = 3, kFriction = 4, kResidual = 5, kEnergy = 6, kContact = 9,
                      kCompensation = 10;

TEST_F(CompensateTest, WritesFrictionResidualAndWhatItCompensates) {
  const auto said = Json(
      {"compensate", "log.csv", "--friction", "friction.json", "--share", ".8", "-o", "o.csv"});
  EXPECT_EQ(said.at("samples"), 480);
  EXPECT_NEAR(said.at("residual_rms").get<double>(), kRipple, 0.02);
  EXPECT_EQ(said.at("contact"), 0.0);

  const auto torque = Column("o.csv", kTorque), friction = Column("o.csv", kFriction);
  const auto residual = Column("o.csv", kResidual), given = Column("o.csv", kCompensation);
  ASSERT_EQ(torque.size(), 480u);
  for (std::size_t i = 0; i < torque.size(); ++i) {
    EXPECT_NEAR(torque[i] - friction[i], residual[i], 1e-12);
    EXPECT_NEAR(given[i], 0.8 * friction[i], 1e-12);
  }

  // the same numbers as HDF5
  Call({"compensate", "log.csv", "--friction", "friction.json", "-o", "o.h5"});
  const auto again = Json({"compensate", "o.h5", "--friction", "friction.json"});
  EXPECT_EQ(again.at("samples"), 480);
}

TEST_F(CompensateTest, CorrectsALevelThatIsOff) {
  const auto open = Json({"compensate", "log.csv", "--friction", "weak.json"});
  const auto corrected =
      Json({"compensate", "log.csv", "--friction", "weak.json", "--correct", "-o", "o.csv"});
  EXPECT_GT(open.at("residual_rms").get<double>(), 0.9);
  EXPECT_LT(corrected.at("residual_rms").get<double>(), 0.4);
  EXPECT_NEAR(corrected.at("state_end").at("correction").get<double>(), 1, 0.1);
  EXPECT_EQ(open.at("state_end").at("correction"), 0.0);
}

TEST_F(CompensateTest, FindsAContact) {
  // 4 N.m in one direction from the 200th to the 260th second
  WriteRecordingFile(at("pushed.csv"), 480, SeveralSpeeds,
                     [](int i) { return i >= 200 && i < 260 ? 4 * Sign(SeveralSpeeds(i)) : 0.0; });
  Call({"compensate", "pushed.csv", "--friction", "friction.json", "--correct", "-o", "o.csv"});
  const auto contact = Column("o.csv", kContact), residual = Column("o.csv", kResidual);
  EXPECT_EQ(contact[190], 0);
  EXPECT_EQ(contact[225], 1);
  EXPECT_NEAR(residual[225], 4, 0.5);
  EXPECT_EQ(contact[400], 0);
}

TEST_F(CompensateTest, GoesOnWithTheHeatThatAPauseLeaves) {
  const std::vector<std::string> log{"compensate", "log.csv", "--friction", "warm.json",
                                     "--state",    "s.json",  "-o",         "o.csv"};
  Call(log);
  const auto kept = JsonFile("s.json");
  const double heat = kept.at("energy");
  EXPECT_LT(heat, -0.5);

  // both logs begin at 0 s: nothing says how long the pause was, and nothing is written
  EXPECT_THAT(Refusal(log), HasSubstr("--pause"));
  EXPECT_EQ(JsonFile("s.json"), kept);
  std::vector<std::string> next = log;
  next.insert(next.end(), {"--pause", "600"});
  Call(next);
  EXPECT_NEAR(Column("o.csv", kEnergy)[0], heat * std::exp(-1), 1e-9);
}

TEST_F(CompensateTest, RefusesAStateOfAnotherJoint) {
  for (const char* state :
       {R"({"energy":-15.1,"second_energy":0,"correction":0,"variance":1,"time":0})",
        R"({"energy":0,"second_energy":0,"correction":1e9,"variance":1,"time":0})"}) {
    WriteWholeFile(at("s.json"), state);
    EXPECT_THAT(Refusal({"compensate", "log.csv", "--friction", "friction.json", "--state",
                         "s.json", "--pause", "0"}),
                HasSubstr("another joint"));
  }
  WriteWholeFile(at("s.json"),
                 R"({"energy":0,"second_energy":0,"correction":0,"variance":-1,"time":0})");
  EXPECT_THAT(
      Refusal({"compensate", "log.csv", "--friction", "friction.json", "--state", "s.json"}),
      HasSubstr("variance"));
}

TEST_F(CompensateTest, RefusesOptionsThatMeanNothing) {
  const std::vector<std::string> joint{"compensate", "log.csv", "--friction", "friction.json"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), joint.begin(), joint.end());
    return Refusal(more);
  };
  EXPECT_THAT(with({"--joints", "a"}), HasSubstr("give --robot"));
  EXPECT_THAT(with({"--robot", "rotary", "--state", "s.json"}), HasSubstr("--state"));
  EXPECT_THAT(with({"--pause", "5"}), HasSubstr("give --state"));
  EXPECT_THAT(with({"--share", "1.5"}), HasSubstr("from 0 to 1"));
  EXPECT_THAT(with({"-o", "log.csv"}), HasSubstr("is an input"));
  EXPECT_THAT(with({"--robot", "rotary"}), HasSubstr("identify-robot"));

  WriteWholeFile(at("robot.json"), R"({"joints":{}})");
  EXPECT_THAT(Refusal({"compensate", "log.csv", "--friction", "robot.json"}), HasSubstr("--robot"));

  // a friction in amperes and a log in N.m
  auto amperes = JsonFile("friction.json");
  amperes["torque_unit"] = "A";
  WriteWholeFile(at("amperes.json"), amperes.dump());
  EXPECT_THAT(
      Refusal({"compensate", "log.csv", "--friction", "amperes.json", "--unit", "torque=N.m"}),
      HasSubstr("in A"));
}

}  // namespace
}  // namespace warmjoint
