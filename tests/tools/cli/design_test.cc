#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "tests/tools/cli/in_a_folder.h"
#include "tests/tools/cli/little_files.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

class DesignCommand : public InAFolder {
 protected:
  ProgramAnswer Into(const std::string& name, const std::vector<std::string>& more = {}) const {
    return Program(With({"design", "--minutes", "4", "--identifier", "energy-ml", "--limits",
                         "position=-1..1,velocity=0.05..1", "-o", name},
                        more));
  }
};

TEST_F(DesignCommand, WritesAMotionThatSimulateCarriesOut) {
  ASSERT_EQ(Into("motion").status, 0);
  for (const char* file : {"motion.csv", "setpoints.csv", "trajectory.yaml", "motion.script"}) {
    EXPECT_FALSE(File(std::string("motion/") + file).empty()) << file;
  }
  const nlohmann::json design = JsonFile("motion/design.json");
  EXPECT_EQ(design.at("foretold").back().at("minutes"), 4);

  // rests and places are those of the file, and the set points lie on them
  WriteWholeFile(at("scenario.yaml"), TableOneYaml(600));
  // between set points, .05 s apart, the velocity is a straight line: a ramp begins late by less than that
  for (const auto& [file, off] :
       {std::pair("motion/motion.csv", 1e-4), {"motion/setpoints.csv", 0.05}}) {
    Call({"simulate", "scenario.yaml", "--motion", file, "--set", "sampling.rate=10", "-o", "log"});
    const nlohmann::json check = Json({"check", "log/recording.csv"});
    EXPECT_EQ(check.at("sampling").at("samples"), 2400);
    EXPECT_GE(check.at("motion").at("travel").at(0).get<double>(), -1 - off);
    EXPECT_LE(check.at("motion").at("travel").at(1).get<double>(), 1 + off);
    EXPECT_GT(check.at("motion").at("constant_share").get<double>(), 0.5);
  }
}

TEST_F(DesignCommand, ChecksWhetherALogIsEnoughAndForetellsWhatItLacks) {
  WriteWholeFile(at("scenario.yaml"), TableOneYaml(3600));
  Call({"simulate", "scenario.yaml", "-o", "log"});
  const auto until = [&](const std::string& log, const std::string& goal) {
    return Program(
        {"check", log, "--until", goal, "--identifier", "energy-ml", "--format", "json"});
  };
  const ProgramAnswer enough = until("log/recording.csv", "thermal_time_constant=5%");
  EXPECT_EQ(enough.status, 0);
  const auto found = nlohmann::json::parse(enough.out);
  EXPECT_LE(found.at("half_width").get<double>(), 0.05);
  EXPECT_LT(found.at("minutes").get<double>(), 60);

  // of half of that the other half is foretold
  const double half = found.at("minutes").get<double>() / 2;
  Call({"simulate", "scenario.yaml", "--set", fmt::format("duration={:.0f}", 60 * half), "-o",
        "half"});
  const ProgramAnswer lacks = until("half/recording.csv", "thermal_time_constant=5%");
  EXPECT_EQ(lacks.status, 3);
  const auto more = nlohmann::json::parse(lacks.out);
  EXPECT_FALSE(more.at("reached").get<bool>());
  EXPECT_NEAR(half + more.at("minutes_more").get<double>(), 2 * half, 0.3 * 2 * half);

  EXPECT_THAT(Refusal({"check", "log/recording.csv", "--until", "friction"}),
              HasSubstr("friction=5%"));
  EXPECT_THAT(Refusal({"check", "log/recording.csv", "--watch"}), HasSubstr("--until"));
}

TEST_F(DesignCommand, WatchesALogThatIsBeingRecorded) {
  WriteWholeFile(at("scenario.yaml"), TableOneYaml(1200));
  Call({"simulate", "scenario.yaml", "--set", "sampling.rate=5", "-o", "log"});
  const std::string whole = File("log/recording.csv");
  const std::vector<std::string> watch{
      "check",   "growing.csv", "--until", "thermal_time_constant=5%", "--identifier", "energy-ml",
      "--watch", "--format",    "json"};

  // parts that end anywhere in a row; the last would not do without the rest
  std::ofstream recorder(at("growing.csv"));
  std::jthread record([&] {
    size_t written = 0;
    for (const size_t part : {size_t{7}, size_t{300}, whole.size() / 9 + 5, whole.size()}) {
      recorder << whole.substr(written, part - written) << std::flush;
      written = part;
      std::this_thread::sleep_for(std::chrono::milliseconds(400));
    }
  });
  const ProgramAnswer watched = Program(watch);
  record.join();
  EXPECT_EQ(watched.status, 0) << watched.err;
  const auto found = nlohmann::json::parse(watched.out);
  EXPECT_NEAR(found.at("minutes").get<double>(), 20, 0.01);
  EXPECT_LE(found.at("half_width").get<double>(), 0.05);

  // what comes through a pipe ends with it
  const auto piped = [&](size_t bytes) {
    const std::string command = fmt::format(
        "head -c {} log/recording.csv | {} check - --until thermal_time_constant=5% "
        "--identifier energy-ml --watch",
        bytes, (test::BuildFolder() / "warmjoint").string());
    return RunCommandLine({"sh", "-c", command}, {at(""), {}}).status;
  };
  EXPECT_EQ(piped(whole.size()), 0);
  EXPECT_EQ(piped(whole.size() / 9), 3);
  EXPECT_EQ(piped(60), 2);
  EXPECT_THAT(Refusal({"check", "log.h5", "--until", "friction=5%", "--watch"}), HasSubstr(".csv"));
}

TEST_F(DesignCommand, ShowsWhatWasForetoldBesideWhatIsReached) {
  ASSERT_EQ(Into("motion").status, 0);
  WriteWholeFile(at("scenario.yaml"), TableOneYaml(600));
  Call({"simulate", "scenario.yaml", "--motion", "motion/motion.csv", "--set", "sampling.rate=20",
        "-o", "log"});
  const std::string out = Call({"identify", "log/recording.csv", "--identifier", "energy-ml",
                                "--design", "motion/design.json"})
                              .out;
  EXPECT_THAT(out, HasSubstr("foretold"));
  EXPECT_THAT(Refusal({"identify", "log/recording.csv", "--design", "log/truth.json"}),
              HasSubstr("design.json"));
}

TEST_F(DesignCommand, TakesNoiseAndWhatIsKnownFromLogs) {
  WriteWholeFile(at("scenario.yaml"), TableOneYaml(600));
  Call({"simulate", "scenario.yaml", "--set", "sampling.rate=5", "-o", "log"});
  ASSERT_EQ(Into("noisy", {"--noise", "log/recording.csv"}).status, 0);
  const nlohmann::json settings = JsonFile("noisy/design.json").at("settings");
  EXPECT_NEAR(settings.at("noise").get<double>(), 0.5, 0.03);  // of Table I, by 3000 samples
  EXPECT_EQ(settings.at("rate"), 5);

  // behind the log the same minutes tell more than alone
  ASSERT_EQ(Into("after", {"--after", "log/recording.csv"}).status, 0);
  const auto deviation = [&](const std::string& folder) {
    const nlohmann::json draw = JsonFile(folder + "/design.json").at("draws").at(0);
    return draw.at("deviations").at("thermal_time_constant").get<double>();
  };
  EXPECT_LT(deviation("after"), 0.5 * deviation("noisy"));
}

TEST_F(DesignCommand, TakesTheLimitsOfARobotsJoint) {
  Call({"design", "linear_axis", "--joint", "carriage", "--limits", "velocity=0.1,acceleration=1",
        "--minutes", "4", "--identifier", "energy-ml", "-o", "motion"});
  const nlohmann::json settings = JsonFile("motion/design.json").at("settings");
  EXPECT_EQ(settings.at("joint"), "linear");
  EXPECT_EQ(settings.at("limits").at("position"), (nlohmann::json{0, 0.25}));
  EXPECT_THAT(Refusal({"design", "linear_axis", "-o", "x"}), HasSubstr("--joint"));
  EXPECT_THAT(Refusal({"design", "--joint", "a", "--joint", "b", "-o", "x"}), HasSubstr("robot"));
  EXPECT_THAT(
      Refusal({"design", "linear_axis", "--joint", "carriage", "--at", "carriage", "-o", "x"}),
      HasSubstr("key=value"));
}

TEST_F(DesignCommand, RefusesLimitsThatAreNone) {
  EXPECT_THAT(Refusal({"design", "-o", "x", "--limits", "speed=1"}), HasSubstr("position=a..b"));
  EXPECT_THAT(Refusal({"design", "-o", "x", "--limits", "velocity=1..0.1"}), HasSubstr("slowest"));
  EXPECT_THAT(Refusal({"design", "-o", "x", "--limits", "position=1..0"}), HasSubstr("lower"));
  EXPECT_THAT(Refusal({"design", "-o", "x", "--noise", "-1"}), HasSubstr("above 0"));
  EXPECT_THAT(Refusal({"design", "-o", "x", "--for", "friction=0"}), HasSubstr("friction=5%"));
  EXPECT_FALSE(std::filesystem::exists(at("x")));
}

}  // namespace
}  // namespace warmjoint
