// A temperature in the log, beside the heat of the fit.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "models/foundation/atomic_file.h"
#include "tests/support/warm_recording.h"
#include "tests/tools/cli/run_program.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

using testing::HasSubstr;

/// An hour of the joint of Table I whose case is 0.25 K warmer for each N.m that it has lost.
void WriteWithThermometer(const std::filesystem::path& path, const std::string& name) {
  const Measurements m =
      test::RecordFriction(test::TableOne(), 1, test::AlternatingSpeeds(3600, 3), 0.3, 3);
  const Eigen::VectorXd energy = PredictFriction(test::TableOne(), m).energy;
  std::string csv = fmt::format("time,position,velocity,torque,{}\n", name);
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    csv += fmt::format("{},{},{},{},{:.1f}\n", m.time[i], m.position[i], m.velocity[i], m.torque[i],
                       25 - 0.25 * energy[i]);
  }
  WriteWholeFile(path, csv);
}

TEST(Temperature, IsSetBesideTheHeatAndDrawn) {
  const ScratchDirectory scratch;
  const auto run = [&](std::vector<std::string> arguments) {
    return RunWarmjoint(std::move(arguments), Surroundings{scratch.path(), {}});
  };
  WriteWithThermometer(scratch.path() / "found.csv", "case_degC");
  WriteWithThermometer(scratch.path() / "named.csv", "thermo");

  const ProgramAnswer text = run({"identify", "found.csv", "-o", "found.json"});
  ASSERT_EQ(text.status, 0) << text.err;
  EXPECT_THAT(text.out, HasSubstr("temperature beside E"));
  EXPECT_THAT(text.out, HasSubstr("has not used the temperature"));
  const auto estimate = nlohmann::json::parse(ReadWholeFile(scratch.path() / "found.json"));
  const auto& told = estimate.at("temperature");
  EXPECT_LT(told.at("correlation").at("value").get<double>(), -0.99);
  EXPECT_NEAR(told.at("per_energy").at("value").get<double>(), -0.25, 0.005);
  EXPECT_NEAR(told.at("per_loss").at("value").get<double>(), 0.75, 0.015);

  // the same by its name, and nothing without it
  const auto of = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"identify", "named.csv", "--format", "json"});
    return nlohmann::json::parse(run(std::move(more)).out);
  };
  EXPECT_EQ(of({"--temperature", "thermo"}).at("temperature"), told);
  EXPECT_FALSE(of({}).contains("temperature"));

  // and its picture
  const ProgramAnswer drawn =
      run({"plot", "found.json", "-o", "pictures", "--figure", "temperature"});
  EXPECT_EQ(drawn.status, 0) << drawn.err;
  EXPECT_TRUE(std::filesystem::exists(scratch.path() / "pictures/temperature.png"));
}

}  // namespace
}  // namespace warmjoint
