#include "tools/suite/working_directory.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;

TEST(WorkingDirectory, IsEmptyOfItsOwnAndGone) {
  fs::path path;
  {
    const WorkingDirectory one, other;
    path = one.path();
    EXPECT_NE(path, other.path());
    EXPECT_TRUE(fs::is_empty(path));
    EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_all);
    std::ofstream(path / "file") << "x";
  }
  EXPECT_FALSE(fs::exists(path));
}

TEST(WorkingDirectory, GoesWithAProcessThatIsKilled) {
  const ScratchDirectory scratch;
  const fs::path name = scratch.path() / "name";
  const pid_t process = fork();
  if (process == 0) {
    const WorkingDirectory directory;
    std::ofstream(directory.path() / "file") << "x";
    std::ofstream(scratch.path() / "part") << directory.path().string();
    fs::rename(scratch.path() / "part", name);
    pause();
    _exit(0);
  }
  const auto wait = [](auto done) {
    for (int i = 0; i < 1000 && !done(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return done();
  };
  ASSERT_TRUE(wait([&] { return fs::exists(name); }));
  std::string path;
  std::getline(std::ifstream(name) >> std::ws, path);
  ASSERT_TRUE(fs::exists(path));
  kill(process, SIGKILL);
  waitpid(process, nullptr, 0);
  EXPECT_TRUE(wait([&] { return !fs::exists(fs::path(path).parent_path()); }));
}

}  // namespace
}  // namespace warmjoint
