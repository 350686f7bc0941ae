#include "tools/suite/memory_of_work.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/foundation/bad_input.h"
#include "scenarios/parse_suite.h"

namespace warmjoint {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A suite of as many variants, without a doubt about the rest.
Suite Little(int variants) {
  std::string yaml = R"(question: Which?
scenario:
  friction: {law: viscous_coulomb, parameters: {viscous: 5, coulomb: 15}}
  motion: {speeds: [1], hold: 1}
  duration: 10
identifiers: [{name: nominal-ls}, {name: energy-ml}]
ladder:
  variable: noise.torque
  values: [0)";
  for (int i = 1; i < variants; ++i) yaml += fmt::format(", {}", i);
  return ParseSuite(yaml + "]", "t.yaml");
}

Suite Large() {
  Suite suite = Little(1);
  suite.ladder.reset();
  suite.scenario.duration = 1e8;
  suite.scenario.sampling.rate = 1e5;
  return suite;
}

TEST(MemoryOfWork, NamesDurationAndRate) {
  EXPECT_THAT([] { RequireMemoryFor(Large().scenario, "s.yaml"); },
              ThrowsMessage<BadInput>(AllOf(
                  HasSubstr("s.yaml: 1e+13 samples (duration 1e+08 s at sampling.rate 100000 Hz) "
                            "take about 2.04 PiB of memory"),
                  HasSubstr("shorten duration or lower sampling.rate"))));
}

TEST(MemoryOfWork, CountsThreads) {
  Suite suite = Large();
  suite.realizations = 100;
  EXPECT_THAT([&] { RequireMemoryFor(suite, {}, 8, "t.yaml"); },
              ThrowsMessage<BadInput>(HasSubstr("8 recordings at once (--jobs)")));
}

TEST(MemoryOfWork, CountsResultsOfTheShard) {
  Suite suite = Little(1000);
  suite.realizations = 10'000'000;
  EXPECT_THAT([&] { RequireMemoryFor(suite, {}, 1, "t.yaml"); },
              ThrowsMessage<BadInput>(HasSubstr("2e+10 results (10000000 realizations")));
  EXPECT_NO_THROW(RequireMemoryFor(suite, {1, 1'000'000}, 1, "t.yaml"));
}

}  // namespace
}  // namespace warmjoint
