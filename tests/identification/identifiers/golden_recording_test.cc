// Identifiers against recordings that the project did not make.
#include <gtest/gtest.h>
#include <warmjoint/prepared_log.h>

#include <map>

#include "tests/support/judging.h"
#include "tests/support/vectors.h"

namespace warmjoint {
namespace {

/// The recording of a law, as a log.
Measurements GoldenLog(const std::string& law) {
  const test::GoldenMotion golden = test::ReadGoldenMotion(law);
  Measurements m = test::Record(golden.trajectory.step, golden.trajectory.velocity, golden.force);
  m.source = law;
  return m;
}

/// What an identifier makes of the log as the command line prepares it: samples at constant speed.
Estimate Identify(const std::string& name, const Measurements& m,
                  const std::map<std::string, std::string>& given) {
  const PreparedLog log = Prepare(m);
  EXPECT_GT(log.constant_speed().selection.count(), m.size() / 2);
  return test::Fitted(name, log, given);
}

/// Largest relative error of the law's parameters, k and tau.
double LargestError(const std::string& law, const Estimate& estimate) {
  double largest = 0;
  for (const auto& [name, value] : test::TruthOf(test::ReadGoldenMotion(law).friction)) {
    const EstimatedParameter* found = estimate.Find(name);
    if (!found) ADD_FAILURE() << name << ": " << estimate.FullMessage();
    if (found) largest = std::max(largest, std::abs(found->value / value - 1));
  }
  return largest;
}

TEST(GoldenRecording, IsRecoveredByMaximumLikelihood) {
  for (const char* law : {"coulomb", "viscous_coulomb", "asymmetric"}) {
    const Estimate estimate = Identify("energy-ml", GoldenLog(law), {{"law", law}});
    EXPECT_EQ(estimate.status, Status::ok) << estimate.FullMessage();
    EXPECT_LT(LargestError(law, estimate), 1e-6) << law;  // an iterative optimiser
  }
}

TEST(GoldenRecording, OfTheStribeckEffectIsRecovered) {
  for (const char* law : {"stribeck", "asymmetric_stribeck"}) {
    const Estimate estimate =
        Identify("stribeck", GoldenLog(law), {{"law", law}, {"warming", "estimated"}});
    EXPECT_EQ(estimate.status, Status::ok) << estimate.FullMessage();
    EXPECT_LT(LargestError(law, estimate), 1e-6) << law;  // an iterative optimiser
  }
}

TEST(GoldenRecording, IsRecoveredByTheAlternatingMethodAndTheFilter) {
  const Measurements m = GoldenLog("viscous_coulomb");
  const Estimate alternating = Identify("energy-als", m, {{"iterations", "500"}});
  EXPECT_EQ(alternating.status, Status::ok) << alternating.FullMessage();
  // it stops where an iteration changes little; its error shrinks by a few per cent in each
  EXPECT_LT(LargestError("viscous_coulomb", alternating), 1e-3);
  // it never calls itself settled where there is no noise to settle within
  const Estimate filtered = Identify("kalman", m, {});
  EXPECT_LT(LargestError("viscous_coulomb", filtered), 1e-3);
}

}  // namespace
}  // namespace warmjoint
