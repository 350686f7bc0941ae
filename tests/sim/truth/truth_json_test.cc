#include "sim/truth/truth.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "models/friction/friction_json.h"
#include "tests/models/recording/temporary_file.h"

namespace warmjoint {
namespace {

using testing::HasSubstr;

Truth Example() {
  Truth truth;
  truth.friction.law = "viscous_coulomb";
  truth.friction.parameters = {{"viscous", 5}, {"coulomb", 15}};
  truth.friction.thermal = Thermal{-3, 600};
  truth.initial_energy = 1.0 / 3;
  truth.torque_noise = 0.5;
  truth.plant = "ideal";
  truth.velocity = Eigen::Vector3d(0.1, -0.1, 1.0 / 7);
  truth.force = Eigen::Vector3d(15.5, -15.5, 15);
  truth.loss = Eigen::Vector3d(1.55, 1.55, 2);
  truth.energy = Eigen::Vector3d(0, -0.1, -1e-17);
  return truth;
}

std::string Refusal(const nlohmann::json& json) {
  try {
    TruthFrom({Tree(json), "truth.json"});
  } catch (const BadInput& refusal) {
    return refusal.what();
  }
  return "";
}

TEST(Truth, ReadsBackBitForBit) {
  const Truth truth = Example();
  const TemporaryFile file("truth.json");
  WriteTruth(truth, file.path());
  const Truth copy = ReadTruth(file.path());
  EXPECT_EQ(FrictionToTree(copy.friction), FrictionToTree(truth.friction));
  EXPECT_EQ(copy.initial_energy, truth.initial_energy);
  EXPECT_EQ(copy.torque_noise, truth.torque_noise);
  EXPECT_EQ(copy.plant, "ideal");
  EXPECT_EQ(copy.velocity, truth.velocity);
  EXPECT_EQ(copy.force, truth.force);
  EXPECT_EQ(copy.loss, truth.loss);
  EXPECT_EQ(copy.energy, truth.energy);
}

TEST(Truth, RefusesWhatIsNoTruth) {
  nlohmann::json json = TruthToTree(Example());
  json.erase("plant");
  EXPECT_THAT(Refusal(json), HasSubstr("truth.json: 'plant' is missing"));

  json = TruthToTree(Example());
  json["energys"] = json["energy"];
  EXPECT_THAT(Refusal(json), HasSubstr("did you mean 'energy'?"));

  json = TruthToTree(Example());
  json["force"] = {1, 2};
  EXPECT_THAT(Refusal(json), HasSubstr("force is a list of 2; it must be as long as velocity"));
  json["force"] = "many";
  EXPECT_THAT(Refusal(json), HasSubstr("force is 'many'"));

  const TemporaryFile file("truth.json", "{");
  EXPECT_THROW(ReadTruth(file.path()), BadInput);
}

}  // namespace
}  // namespace warmjoint
