#include "tools/suite/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/foundation/atomic_file.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

using testing::ElementsAre;

TEST(CommandLineOfOthers, NamesOfFilesBecomeAbsolute) {
  const ScratchDirectory scratch;
  const std::filesystem::path folder = scratch.path();
  std::filesystem::create_directory(folder / "sub");
  for (const char* name : {"mine.py", "sub/other.py", "sh", "run it"}) {
    WriteWholeFile(folder / name, "");
  }
  const auto at = [&](const char* name) { return (folder / name).string(); };
  using Words = std::vector<std::string>;
  const Words given{"python3",          "mine.py", "sub/other.py", "none.py",    "{recording}",
                    "--config=mine.py", "sub",     "run it",       at("mine.py")};
  EXPECT_THAT(WithAbsoluteFiles(given, folder),
              ElementsAre("python3", at("mine.py"), at("sub/other.py"), "none.py", "{recording}",
                          "--config=mine.py", "sub", at("run it"), at("mine.py")));
  EXPECT_THAT(WithAbsoluteFiles(Words{"sh", "sh"}, folder), ElementsAre("sh", at("sh")))
      << "a program of PATH stays one";
  EXPECT_THAT(WithAbsoluteFiles(Words{"mine.py"}, folder), ElementsAre(at("mine.py")))
      << "which PATH does not have";
  EXPECT_EQ(WithAbsoluteFiles("sh  mine.py | sh; cat none.py", folder),
            "sh  " + at("mine.py") + " | sh; cat none.py");
}

}  // namespace
}  // namespace warmjoint
