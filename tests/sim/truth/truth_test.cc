#include <gtest/gtest.h>
#include <warmjoint/simulation.h>

#include <nlohmann/json.hpp>

#include "models/foundation/serialize.h"
#include "models/friction/friction_json.h"
#include "tests/models/recording/temporary_file.h"
#include "tests/support/refusal.h"

namespace warmjoint {
namespace {

Truth Example() {
  Truth truth;
  truth.friction = {"viscous_coulomb", {{"viscous", 5}, {"coulomb", 15}}, Thermal{-3, 600}};
  truth.initial_energy = 1.0 / 3;
  truth.torque_noise = 0.5;
  truth.plant = "ideal";
  truth.velocity = Eigen::Vector3d(0.1, -0.1, 1.0 / 7);
  truth.force = Eigen::Vector3d(15.5, -15.5, 15);
  truth.loss = Eigen::Vector3d(1.55, 1.55, 2);
  truth.energy = Eigen::Vector3d(0, -0.1, -1e-17);
  return truth;
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
  const auto refusal = [](const std::string& key, const nlohmann::json& value) {
    Tree tree = WriteFields(Example());
    tree[key] = value;
    return test::RefusalOf([&] { ReadAs<Truth>({tree, "truth.json"}); });
  };
  test::ExpectNamed(refusal("plant", nullptr), {"truth.json: ", "'plant' is missing"});
  test::ExpectNamed(refusal("energys", {1}),
                    {"truth.json: ", "'energys'", "did you mean 'energy'"});
  test::ExpectNamed(refusal("force", {1, 2}), {"truth.json: ", "force is a list of 2", "velocity"});
  test::ExpectNamed(refusal("force", "many"), {"truth.json: ", "force is 'many'"});

  const TemporaryFile file("truth.json", "{");
  EXPECT_THROW(ReadTruth(file.path()), BadInput);
}

}  // namespace
}  // namespace warmjoint
