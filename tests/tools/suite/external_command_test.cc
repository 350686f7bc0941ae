#include "tools/suite/external_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/foundation/atomic_file.h"
#include "models/foundation/bad_input.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

SuiteIdentifier Entry(const std::string& command) {
  return {kExternal, "mine", {{"command", command}}, {}};
}

TEST(ExternalCommand, OfASuiteReadsItsOwnFilesAndNotTheSuite) {
  const ScratchDirectory scratch;
  const fs::path folder = scratch.path();
  fs::create_directory(folder / "ids");
  for (const char* name : {"mine.py", "ids/theirs.py", "suite.yaml"}) {
    WriteWholeFile(folder / name, "");
  }
  const auto resolved = [&](const std::string& command) {
    return WithFilesOfSuite(Entry(command + " {recording} {estimate}"), folder / "suite.yaml");
  };
  const SuiteIdentifier mine = resolved("python3 mine.py");
  EXPECT_EQ(mine.options.at("command"),
            "python3 " + (folder / "mine.py").string() + " {recording} {estimate}");
  EXPECT_THAT(ReadableBy(mine), Contains(folder / "mine.py"));
  EXPECT_THAT(ReadableBy(mine), Not(Contains(folder)));

  // modules in a folder of their own are open
  EXPECT_THAT(ReadableBy(resolved("python3 ids/theirs.py")), Contains(folder / "ids"));
  EXPECT_THAT(ReadableBy(resolved("python3 ./mine.py")), Not(Contains(folder / ".")));

  // what names no file of the suite's folder stays as it is
  EXPECT_EQ(resolved("python3 none.py"), Entry("python3 none.py {recording} {estimate}"));
  const SuiteIdentifier again = WithFilesOfSuite(mine, folder / "ids" / "suite.yaml");
  EXPECT_EQ(again, mine);
}

TEST(ExternalCommand, IsRefusedWithoutItsPlaceholders) {
  const auto refusal = [](const std::string& argument) {
    try {
      ReadExternal(argument, CommandForm::words);
    } catch (const BadInput& error) {
      return std::string(error.what());
    }
    return std::string("(accepted)");
  };
  EXPECT_THAT(refusal("mine=a {recording}"), HasSubstr("mine: the command lacks {estimate}"));
  EXPECT_THAT(refusal("mine=a {estimate}"), HasSubstr("lacks {recording}"));
  EXPECT_THAT(refusal("=a {recording} {estimate}"), HasSubstr("lacks its name"));
  EXPECT_EQ(refusal("mine=a {recording.h5} {estimate}"), "(accepted)");
}

}  // namespace
}  // namespace warmjoint
