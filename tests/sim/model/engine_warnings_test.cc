// MuJoCo's warnings where someone takes them: from every thread, each kind once, and never a file.
#include "sim/model/engine_warnings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <filesystem>
#include <string>
#include <thread>
#include <vector>

namespace warmjoint {
namespace {

using testing::ElementsAre;

void Ignore(const char*) {}

TEST(EngineWarnings, TakesEachKindOnceFromAllThreadsAndLeavesNoFile) {
  const bool before = std::filesystem::exists("MUJOCO_LOG.TXT");
  std::vector<std::string> outer, inner;
  {
    const EngineWarnings taken([&](const std::string& one) { outer.push_back(one); });
    mju_warning("QVEL at DOF %d. Time = %.2f.", 3, 0.5);
    std::thread([] { mju_warning("QVEL at DOF %d. Time = %.2f.", 12, 1.5); }).join();
    {
      const EngineWarnings also([&](const std::string& one) { inner.push_back(one); });
      mju_warning("other\x1b[31m");
    }
    mju_warning("last");
  }
  EXPECT_THAT(outer, ElementsAre("MuJoCo: QVEL at DOF 3. Time = 0.50.", "MuJoCo: other\\x1B[31m",
                                 "MuJoCo: last"));
  EXPECT_THAT(inner, ElementsAre("MuJoCo: other\\x1B[31m"));
  EXPECT_EQ(std::filesystem::exists("MUJOCO_LOG.TXT"), before);
}

TEST(EngineWarnings, GivesTheHandlerBackThatWasThereBefore) {
  auto* const before = mju_user_warning;
  mju_user_warning = &Ignore;
  {
    const EngineWarnings taken([](const std::string&) {});
  }
  EXPECT_EQ(mju_user_warning, &Ignore);
  mju_user_warning = before;
}

}  // namespace
}  // namespace warmjoint
