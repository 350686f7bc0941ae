// The compensators that suites compare, on an hour of a joint that warms.
#include <gtest/gtest.h>
#include <warmjoint/simulation.h>

#include <cmath>

#include "identification/score/compensation_score.h"
#include "models/foundation/bad_input.h"
#include "scenarios/read_scenario.h"
#include "sim/plant/plant.h"
#include "tools/compensate/arms/arm_list.h"
#include "tools/suite/prepare_identifiers.h"
#include "tools/suite/run_realization.h"

namespace warmjoint {
namespace {

constexpr char kSuite[] = R"(name: little
question: Which compensation stays true?
seed: 3
scenario:
  friction: {law: viscous_coulomb, parameters: {viscous: 5, coulomb: 15},
             thermal: {thermal_gain: -0.75, thermal_time_constant: 600}}
  motion: {speeds: {uniform: [0.1, 1]}, hold: 5}
  noise: {torque: 0.5}
  sampling: {rate: 20}
  duration: 3600
  disturbances:
    second_heat: {thermal_gain: -0.25, thermal_time_constant: 3600}
    CONTACT
compensators:
)";

/// What each compensator of a list reaches: {label: result}.
std::map<std::string, Result> Reached(const std::string& compensators,
                                      const std::string& contact = "") {
  std::string text = kSuite + compensators;
  text.replace(text.find("CONTACT"), 7, contact);
  const Suite suite = ParseSuite(text, "little.yaml");
  const RealizationResult done = RunRealization(
      MakeBench(suite.scenario), PrepareContestants(suite, {"little.yaml"}), {0, 0}, "");
  std::map<std::string, Result> reached;
  for (const Result& result : done.realization.results) {
    reached[suite.identifiers[static_cast<std::size_t>(result.identifier)].label] = result;
  }
  return reached;
}

double Measure(const Result& result, const std::string& name) {
  for (const auto& [known, value] : result.measures) {
    if (known == name) return value;
  }
  return std::nan("");
}

TEST(CompensatorArms, EachGivesATorque) {
  std::string all;
  for (const CompensatorArm& arm : CompensatorArms()) {
    all += "  - {name: " + arm.name + (arm.name == "level" ? ", options: {begin: \"900\"}" : "") +
           "}\n";
    EXPECT_FALSE(arm.summary.empty());
  }
  const auto reached = Reached(all);
  EXPECT_EQ(reached.size(), CompensatorArms().size());
  for (const auto& [label, result] : reached) {
    EXPECT_EQ(result.status, "ok") << label << ": " << result.message;
    EXPECT_EQ(result.measures.size(), kCompensationMeasures.size());
    EXPECT_EQ(result.trace.rows(), 60u) << "a row a minute";
  }
  const auto residual = [&](const char* label) { return Measure(reached.at(label), "residual"); };
  EXPECT_NEAR(residual("none"), 100, 1e-9);
  EXPECT_EQ(residual("truth"), 0);
  // heat beside what has none, and corrected: the second stage and noise are what is left
  EXPECT_LT(residual("heat"), 0.5);
  EXPECT_LT(residual("heat"), residual("level"));
  EXPECT_LT(residual("level"), residual("least-squares"));
  EXPECT_GT(residual("fixed"), 20);
  EXPECT_LT(residual("polynomial"), residual("fixed") / 3);
}

TEST(CompensatorArms, ATableByALateTemperatureHelpsSomewhat) {
  const auto reached = Reached(
      "  - {name: fixed, label: mean, options: {knows: before}}\n"
      "  - {name: fixed, label: table, options: {knows: temperature}}\n  - {name: heat}\n");
  ASSERT_EQ(reached.at("table").status, "ok") << reached.at("table").message;
  const auto residual = [&](const char* label) { return Measure(reached.at(label), "residual"); };
  EXPECT_LT(residual("table"), residual("mean"));
  EXPECT_GT(residual("table"), residual("heat")) << "a sensor that is late";
}

TEST(CompensatorArms, AContactIsNotTakenForFriction) {
  const auto reached = Reached("  - {name: level, options: {begin: \"900\"}}\n  - {name: heat}\n",
                               "contact: {torque: 2, begin: 120, end: 1320}");
  EXPECT_LT(std::abs(Measure(reached.at("heat"), "contact_bias")), 0.5);
  EXPECT_GT(Measure(reached.at("heat"), "contact_width"), 0.1);
}

TEST(CompensatorArms, KnowTheFrictionOfAJointThatLiftsItsWeightAndIsHeld) {
  // half an hour in the engine with rests, of which the drive holds the pendulum at an angle
  std::string text = kSuite;
  const auto replace = [&](const std::string& old, const std::string& with) {
    text.replace(text.find(old), old.size(), with);
  };
  replace("scenario:\n", "scenario:\n  plant: mujoco\n  robot: pendulum\n  joint: hinge\n");
  replace("hold: 5}", "travel: [0.5, 2.5], rests: {run: 700, rest: 200}}");
  replace("  duration: 3600", "  timestep: 0.002\n  duration: 1800");
  replace("{rate: 20}", "{rate: 20, sensor_rate: 100}");
  replace(
      "  disturbances:\n    second_heat: {thermal_gain: -0.25, thermal_time_constant: 3600}\n    "
      "CONTACT\n",
      "");
  text +=
      "  - {name: none}\n  - {name: level, options: {begin: \"900\"}}\n  - {name: heat}\n  - "
      "{name: truth}\n";
  const Suite suite = ParseSuite(text, "little.yaml");
  const RealizationResult done = RunRealization(
      MakeBench(suite.scenario), PrepareContestants(suite, {"little.yaml"}), {0, 0}, "");
  const auto measured = [&](std::size_t i, const char* name) {
    const Result& result = done.realization.results[i];
    EXPECT_EQ(result.status, "ok") << result.message;
    return Measure(result, name);
  };
  // weight and inertia are no friction: what is left without any is all of it
  EXPECT_NEAR(measured(0, "residual"), 100, 1e-6);
  EXPECT_LT(measured(1, "residual"), 3);
  EXPECT_LT(measured(2, "residual"), 0.3);
  EXPECT_EQ(measured(3, "residual"), 0);
  // four samples of white noise, as for a joint without weight
  EXPECT_LT(measured(3, "push"), 1.2);
}

TEST(CompensatorArms, AreFoundByNameAndOption) {
  EXPECT_THROW(FindCompensator("haet"), BadInput);
  EXPECT_THROW(Reached("  - {name: heat, options: {gian: \"1\"}}\n"), BadInput);
  EXPECT_THROW(Reached("  - {name: energy-ml}\n"), BadInput);
}

}  // namespace
}  // namespace warmjoint
