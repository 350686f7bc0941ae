#include "tools/cluster/task_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <thread>
#include <vector>

#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

TEST(TaskFolder, IsMadeWhileOthersOfThePlanRemoveTheirCommonFolder) {
  const ScratchDirectory scratch;
  setenv("TMPDIR", scratch.path().c_str(), 1);
  Plan plan;
  plan.id = "0123456789abcdef";
  {
    std::vector<std::jthread> tasks;
    for (int number = 1; number <= 4; ++number) {
      tasks.emplace_back([&plan, number] {
        for (int i = 0; i < 500; ++i) {
          const TaskFolder folder(plan, number);
          EXPECT_TRUE(std::filesystem::is_directory(folder.path())) << number;
          folder.Remove();
        }
      });
    }
  }
  const std::filesystem::path user = TaskFolder(plan, 1).path().parent_path().parent_path();
  TaskFolder(plan, 1).Remove();
  EXPECT_TRUE(std::filesystem::is_empty(user));
  unsetenv("TMPDIR");
}

}  // namespace
}  // namespace warmjoint
