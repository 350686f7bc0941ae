#include "models/foundation/atomic_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <thread>

#include "models/foundation/bad_input.h"
#include "tests/support/refusal.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;

class AtomicFileTest : public testing::Test {
 protected:
  int FileCount() const {
    return static_cast<int>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  const ScratchDirectory scratch_;
  const fs::path folder_ = scratch_.path();
};

TEST_F(AtomicFileTest, AppearsOnCommit) {
  AtomicFile file(folder_ / "a.txt");
  file.Write("who");
  file.Write("le");
  EXPECT_FALSE(fs::exists(folder_ / "a.txt"));
  file.Commit();
  EXPECT_EQ(ReadWholeFile(folder_ / "a.txt"), "whole");
  EXPECT_EQ(FileCount(), 1);
}

TEST_F(AtomicFileTest, LeavesNothingWithoutCommit) {
  WriteWholeFile(folder_ / "a.txt", "old");
  {
    AtomicFile file(folder_ / "a.txt");
    file.Write("half");
  }
  EXPECT_EQ(ReadWholeFile(folder_ / "a.txt"), "old");
  EXPECT_EQ(FileCount(), 1);
}

TEST_F(AtomicFileTest, LeavesNothingWhereTheProcessIsKilled) {
  const pid_t child = fork();
  if (child == 0) {
    AtomicFile file(folder_ / "a.txt");
    file.Write("half");
    kill(getpid(), SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(FileCount(), 0);
}

TEST_F(AtomicFileTest, RefusesWhatIsNoRegularFileAndLeavesItAsItIs) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const fs::path& name : {pipe, fs::path("/dev/null"), folder_}) {
    EXPECT_THAT(test::RefusalOf([&] { WriteWholeFile(name, "x"); }),
                testing::HasSubstr(name.string() + ": is no regular file"));
  }
  EXPECT_TRUE(fs::is_fifo(pipe) && fs::is_character_file("/dev/null"));
  EXPECT_THAT(test::RefusalOf([&] { WriteWholeFile("", "x"); }),
              testing::HasSubstr("name is empty"));
  EXPECT_THAT(test::RefusalOf([&] { WriteWholeFile(folder_ / "nowhere" / "a.txt", "x"); }),
              testing::HasSubstr("nowhere' cannot be written to"));
  EXPECT_THAT(test::RefusalOf([&] { AtomicFile(folder_ / std::string(300, 'n')); }),
              testing::HasSubstr("name too long"));
  EXPECT_EQ(FileCount(), 1);
}

TEST_F(AtomicFileTest, FollowsALink) {
  fs::create_directory(folder_ / "elsewhere");
  WriteWholeFile(folder_ / "elsewhere/a.txt", "old");
  fs::create_symlink("elsewhere/a.txt", folder_ / "link");
  WriteWholeFile(folder_ / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(ReadWholeFile(folder_ / "elsewhere/a.txt"), "new");
}

TEST_F(AtomicFileTest, KeepsTheModeOfAFileAndHonoursTheMaskForANewOne) {
  const auto mode = [&](const char* name) {
    struct stat status {};
    stat((folder_ / name).c_str(), &status);
    return status.st_mode & 07777;
  };
  WriteWholeFile(folder_ / "secret", "old");
  fs::permissions(folder_ / "secret", fs::perms(0600));
  WriteWholeFile(folder_ / "secret", "new");
  EXPECT_EQ(mode("secret"), 0600u);

  const mode_t mask = umask(0);
  umask(mask);
  WriteWholeFile(folder_ / "new", "new");
  EXPECT_EQ(mode("new"), 0666u & ~mask);
}

TEST_F(AtomicFileTest, TwoOfOneNameDoNotMeet) {
  AtomicFile one(folder_ / "a.txt"), two(folder_ / "a.txt");
  one.Write("one");
  two.Write("two");
  two.Commit();
  one.Commit();
  EXPECT_EQ(ReadWholeFile(folder_ / "a.txt"), "one");
  EXPECT_EQ(FileCount(), 1);
  EXPECT_TRUE(IsUnderConstruction(".warmjoint.part.a1B2c3"));
  EXPECT_FALSE(IsUnderConstruction("a.txt"));
  EXPECT_FALSE(IsUnderConstruction(".warmjoint.part"));
}

TEST_F(AtomicFileTest, GoesToStandardOutputAfterWhatWasPrinted) {
  for (const char* name : {"-", "/dev/stdout"}) {
    testing::internal::CaptureStdout();
    std::printf("before\n");
    WriteWholeFile(name, "whole\n");
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "before\nwhole\n");
  }
}

/// Files may have no more than this many bytes while it lives.
class FileLimit {
 public:
  explicit FileLimit(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{bytes, old_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
    signal_ = signal(SIGXFSZ, SIG_IGN);
  }
  ~FileLimit() {
    setrlimit(RLIMIT_FSIZE, &old_);
    signal(SIGXFSZ, signal_);
  }

 private:
  rlimit old_{};
  void (*signal_)(int) = nullptr;
};

TEST_F(AtomicFileTest, AFailureToWriteIsToldAndLeavesTheOldFile) {
  WriteWholeFile(folder_ / "a.txt", "old");
  const FileLimit limit(1000);
  EXPECT_THROW(WriteWholeFile(folder_ / "a.txt", std::string(2000, 'x')), OutputFailed);
  EXPECT_EQ(ReadWholeFile(folder_ / "a.txt"), "old");
  EXPECT_EQ(FileCount(), 1);
}

TEST_F(AtomicFileTest, ReadsPipesAndRefusesDevicesFoldersAndWhatIsNotThere) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const std::string text(200'000, 'x');
  std::thread writer([&] { std::ofstream(pipe) << text; });
  EXPECT_EQ(ReadWholeFile(pipe), text);
  writer.join();
  EXPECT_THAT(test::RefusalOf([] { ReadWholeFile("/dev/zero"); }),
              testing::HasSubstr("is a device"));
  EXPECT_THROW(ReadWholeFile(folder_), BadInput);
  EXPECT_THROW(ReadWholeFile(folder_ / "absent.json"), BadInput);
}

TEST_F(AtomicFileTest, ReadsNoMoreThanIsAllowed) {
  WriteWholeFile(folder_ / "a.txt", std::string(2000, 'x'));
  EXPECT_EQ(ReadWholeFile(folder_ / "a.txt", 2000).size(), 2000u);
  EXPECT_THAT(test::RefusalOf([&] { ReadWholeFile(folder_ / "a.txt", 1999); }),
              testing::HasSubstr("more than"));
}

}  // namespace
}  // namespace warmjoint
