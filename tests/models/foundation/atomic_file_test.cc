#include "models/foundation/atomic_file.h"

#include <gmock/gmock.h>

#include <fstream>

#include "models/foundation/bad_input.h"

namespace warmjoint {
namespace {
namespace fs = std::filesystem;

class AtomicFileTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  int FileCount() const {
    return static_cast<int>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

TEST_F(AtomicFileTest, AppearsOnCommit) {
  AtomicFile file(folder_ / "a.txt");
  std::ofstream(file.temporary()) << "whole";
  EXPECT_FALSE(fs::exists(folder_ / "a.txt"));
  file.Commit();
  EXPECT_EQ(ReadWholeFile(folder_ / "a.txt"), "whole");
  EXPECT_EQ(FileCount(), 1);
}

TEST_F(AtomicFileTest, LeavesNothingWithoutCommit) {
  WriteWholeFile(folder_ / "a.txt", "old");
  {
    AtomicFile file(folder_ / "a.txt");
    std::ofstream(file.temporary()) << "half";
  }
  EXPECT_EQ(ReadWholeFile(folder_ / "a.txt"), "old");
  EXPECT_EQ(FileCount(), 1);
}

TEST_F(AtomicFileTest, KeepsTheExtensionForWritersThatLookAtIt) {
  EXPECT_EQ(AtomicFile(folder_ / "fit.png").temporary().extension(), ".png");
}

TEST_F(AtomicFileTest, RefusesAMissingFolder) {
  try {
    AtomicFile file(folder_ / "nowhere" / "a.txt");
    FAIL() << "accepted";
  } catch (const BadInput& refusal) {
    EXPECT_THAT(refusal.what(), testing::HasSubstr("nowhere' does not exist"));
  }
}

TEST_F(AtomicFileTest, ReadingNamesTheMissingFile) {
  EXPECT_THROW(ReadWholeFile(folder_ / "absent.json"), BadInput);
  EXPECT_THROW(ReadWholeFile(folder_), BadInput);
}

}  // namespace
}  // namespace warmjoint
