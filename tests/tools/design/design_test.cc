#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <warmjoint/design.h>
#include <warmjoint/errors.h>
#include <warmjoint/prepared_log.h>

#include <cmath>

#include "identification/score/cramer_rao.h"
#include "models/foundation/atomic_file.h"
#include "sim/plant/plant.h"
#include "tests/tools/scratch_directory.h"
#include "tools/design/possible_joint.h"
#include "tools/design/search_speeds.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;

constexpr const char* kTableOne =
    "law: viscous_coulomb\n"
    "parameters: {viscous: 5, coulomb: 15}\n"
    "thermal: {thermal_gain: -3, thermal_time_constant: 600}\n";
constexpr const char* kRanges =
    "law: viscous_coulomb\n"
    "parameters: {viscous: 5, coulomb: 15}\n"
    "thermal: {thermal_gain: {uniform: [-4, -1]}, thermal_time_constant: {log_uniform: [200, "
    "1800]}}\n";

class DesignedMotion : public testing::Test {
 protected:
  DesignSettings Settings(const char* prior, const std::string& aim) const {
    WriteWholeFile(scratch_.path() / "prior.yaml", prior);
    DesignSettings settings;
    settings.prior = scratch_.path() / "prior.yaml";
    settings.aim = AimFrom(aim);
    settings.identifier = "energy-ml";
    settings.noise = 0.5;
    return settings;
  }
  double Relative(const Design& design, size_t draw, const std::string& name) const {
    for (const auto& [parameter, deviation] : design.draws[draw].deviations) {
      if (parameter == name) return deviation;
    }
    return NAN;
  }

  const ScratchDirectory scratch_;
};

/// The ideal plant's log of a motion.
Simulation Logged(const Design& design, const Friction& friction) {
  Scenario scenario;
  scenario.name = "log";
  scenario.friction = friction;
  scenario.motion.start = design.knots.front().position;
  for (const MotionKnot& knot : design.knots) {
    scenario.motion.corners.push_back({knot.time, knot.velocity});
  }
  scenario.noise.torque = *design.settings.noise;
  scenario.sampling.rate = design.settings.rate;
  scenario.duration = design.knots.back().time;
  return MakeIdealPlant(scenario)->Run(0);
}

TEST_F(DesignedMotion, SaysTheDeviationsThatTheBoundOfItsLogHas) {
  const Design design = DesignMotion(Settings(kTableOne, "D"));
  const Simulation made = Logged(design, design.draws[0].friction);
  const PreparedLog log = Prepare(made.measurements);
  const CramerRao bound = CramerRaoBound(log.raw().measurements, log.raw().selection, made.truth,
                                         KnownInitialEnergy::yes, 1 / design.settings.rate);
  const std::vector<std::pair<std::string, double>> truth{
      {"viscous", 5}, {"coulomb", 15}, {"thermal_gain", 3}, {"thermal_time_constant", 600}};
  for (size_t i = 0; i < truth.size(); ++i) {
    const auto& [name, value] = truth[i];
    const double exact = bound.continuous[static_cast<Eigen::Index>(i)] / value;
    // cells of 2 s against samples of 50 ms
    EXPECT_NEAR(Relative(design, 0, name), exact, 0.03 * exact) << name;
    // what the identifier says of one log
    const auto& answer = design.foretold.back();
    ASSERT_EQ(answer.status, Status::ok) << answer.message;
    const auto found = std::ranges::find(answer.parameters, name, &EstimatedParameter::name);
    ASSERT_NE(found, answer.parameters.end());
    EXPECT_NEAR(*found->std / value, exact, 0.05 * exact) << name;
  }
}

TEST_F(DesignedMotion, TellsMoreThanRandomSpeedsAndALadder) {
  // shares of the standard deviation, as the exchange reaches them for the prior alone
  for (const auto& [aim, most] : {std::pair("thermal_time_constant", 0.6), {"D", 0.75}}) {
    const Design design = DesignMotion(Settings(kTableOne, aim));
    for (const DesignRatio& ratio : design.ratios) {
      EXPECT_LT(ratio.middle, most) << aim << " against " << ratio.against;
      EXPECT_EQ(ratio.middle, ratio.worst) << "one friction is its own worst";
    }
  }
}

TEST_F(DesignedMotion, AveragesOverDrawsOfThePrior) {
  DesignSettings settings = Settings(kRanges, "thermal_time_constant");
  settings.minutes = 10;
  const Design design = DesignMotion(settings);
  ASSERT_EQ(design.draws.size(), 9);
  // drawn frictions differ from each other by what the ranges allow
  double shortest = 1e9, longest = 0;
  for (const DesignDraw& draw : design.draws) {
    const double tau = draw.friction.thermal->time_constant;
    shortest = std::min(shortest, tau);
    longest = std::max(longest, tau);
  }
  EXPECT_GT(longest, 4 * shortest);
  EXPECT_LT(design.ratios[0].worst, 1) << "random speeds are worse for each draw";
}

TEST_F(DesignedMotion, SameSettingsGiveTheSameFiles) {
  DesignSettings settings = Settings(kRanges, "D");
  settings.minutes = 5;
  const auto files = FilesOf(DesignMotion(settings));
  EXPECT_EQ(FilesOf(DesignMotion(settings)), files);
  settings.seed = 2;
  EXPECT_NE(FilesOf(DesignMotion(settings))[1], files[1]);
}

TEST_F(DesignedMotion, KeepsFrictionBelowTheTorqueAndStrokesWithinTheirRoom) {
  DesignSettings settings = Settings(kTableOne, "D");
  settings.minutes = 5;
  settings.limits.torque = 18;  // friction of the cold joint at 0.6 rad/s
  settings.limits.position = {-0.5, 0.8};
  const Design design = DesignMotion(settings);
  double fastest = 0;
  for (const MotionKnot& knot : design.knots) {
    fastest = std::max(fastest, std::abs(knot.velocity));
    EXPECT_GE(knot.position, -0.5 - 1e-9);
    EXPECT_LE(knot.position, 0.8 + 1e-9);
  }
  EXPECT_LE(fastest, 0.6 + 1e-6);
  EXPECT_GT(fastest, 0.5);
  const Simulation made = Logged(design, design.draws[0].friction);
  EXPECT_LE(made.truth.force.cwiseAbs().maxCoeff(), 18 + 1e-6);
}

TEST_F(DesignedMotion, RefusesWhatCannotBeWithTheNumberThatCan) {
  const auto refusal = [](const DesignSettings& settings) {
    try {
      DesignMotion(settings);
    } catch (const BadInput& refused) {
      return std::string(refused.what());
    }
    return std::string();
  };
  DesignSettings settings = Settings(kTableOne, "thermal_gian");
  EXPECT_THAT(refusal(settings), HasSubstr("thermal_gain"));
  settings = Settings(kTableOne, "D");
  settings.limits.torque = 10;
  EXPECT_THAT(refusal(settings), HasSubstr("torque is 10"));
  settings = Settings(kTableOne, "D");
  settings.limits.position = {-0.1, 0.1};
  EXPECT_THAT(refusal(settings), HasSubstr("lower velocity to"));
  settings = Settings(
      "law: stribeck\nparameters: {viscous: 5, coulomb: 15, static: 20, stribeck_velocity: 0.1}\n",
      "D");
  EXPECT_THAT(refusal(settings), HasSubstr("viscous_coulomb"));
}

/// The share of a motion at speeds well between the slowest and the fastest.
double ShareBetween(const std::vector<SpeedBlock>& blocks, const MotionLimits& limits) {
  double between = 0, all = 0;
  for (const SpeedBlock& block : blocks) {
    all += block.duration;
    if (block.speed > 1.5 * limits.velocity[0] && block.speed < limits.velocity[1] / 1.5) {
      between += block.duration;
    }
  }
  return between / all;
}

TEST(SpeedSearch, FrictionWithACurveIsLookedAtAtAllSpeeds) {
  DesignSettings settings;
  settings.minutes = 10;
  settings.aim = AimFrom("friction");
  Friction friction;
  friction.law = "viscous_coulomb";
  friction.parameters = {{"viscous", 5}, {"coulomb", 15}};
  friction.thermal = Thermal{};
  friction.thermal->gain = -1;
  friction.thermal->time_constant = 600;
  const std::vector<PossibleJoint> law{{friction, StartBelief::cold, 0.5, 20}};
  const std::vector<PossibleJoint> curved{
      {friction, StartBelief::cold, 0.5, 20, settings.limits.velocity}};
  // a line is known by its ends
  const auto of_law = SearchSpeeds({settings, law});
  const auto of_curve = SearchSpeeds({settings, curved});
  EXPECT_LT(ShareBetween(of_law, settings.limits), 0.3);
  EXPECT_GT(ShareBetween(of_curve, settings.limits), 0.4);
  // and the curve's motion is the better one for it
  const SpeedSearch search{settings, curved};
  const AimCost cost = CostsOf(search).front();
  const auto known = [&](const std::vector<SpeedBlock>& blocks) {
    return CostOf(LayOut(blocks, settings.limits, settings.hold), search, cost, curved.front());
  };
  EXPECT_LT(known(of_curve), known(of_law));
  EXPECT_LT(known(of_curve), known(RandomSpeeds(settings, 1)));
}

TEST(Aim, IsReadAndWrittenAlike) {
  for (const char* text : {"D", "friction", "friction=5%", "thermal_gain", "thermal_gain=12.5%"}) {
    EXPECT_EQ(TextOf(AimFrom(text)), text);
  }
  EXPECT_EQ(TextOf(AimFrom("coulomb=0.05")), "coulomb=5%");
  for (const char* text :
       {"", "=5%", "D=5%", "coulomb=", "coulomb=0", "coulomb=100%", "coulomb=x"}) {
    EXPECT_THROW(AimFrom(text), BadInput) << text;
  }
}

}  // namespace
}  // namespace warmjoint
