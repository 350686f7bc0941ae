// Outputs of a command: never over an input, and none before all are made.
#include "tools/actions/outputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/foundation/atomic_file.h"
#include "tests/support/refusal.h"
#include "tests/tools/scratch_directory.h"

namespace warmjoint {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class OutputsTest : public testing::Test {
 protected:
  fs::path At(const std::string& name) const { return scratch_.path() / name; }
  const ScratchDirectory scratch_;
};

TEST_F(OutputsTest, AreThereTogether) {
  Outputs outputs({At("a.json"), "", At("b.xml")}, {});
  outputs.Add(At("a.json"), "a");
  outputs.Add(At("pictures/c.png"), "c");
  outputs.Add("", "nothing");
  EXPECT_TRUE(fs::is_empty(scratch_.path()));
  outputs.Write();
  EXPECT_EQ(ReadWholeFile(At("a.json")), "a");
  EXPECT_EQ(ReadWholeFile(At("pictures/c.png")), "c");
  EXPECT_FALSE(fs::exists(At("b.xml")));
}

TEST_F(OutputsTest, NoneIsThereWhereOneCannotBe) {
  Outputs outputs({At("a.json")}, {});
  outputs.Add(At("a.json"), "a");
  WriteWholeFile(At("file"), "no folder");
  outputs.Add(At("file/c.png"), "c");
  EXPECT_ANY_THROW(outputs.Write());
  EXPECT_FALSE(fs::exists(At("a.json")));
}

TEST_F(OutputsTest, NeverGoOntoAnInput) {
  WriteWholeFile(At("log.csv"), "mine");
  fs::create_directory(At("bag"));
  WriteWholeFile(At("bag/part.db3"), "mine");
  fs::create_symlink("log.csv", At("link"));
  for (const char* name : {"log.csv", "link", "bag/../log.csv"}) {
    EXPECT_THAT(test::RefusalOf([&] { Outputs({At(name)}, {At("log.csv")}); }),
                HasSubstr("is an input too"));
  }
  EXPECT_THAT(test::RefusalOf([&] { Outputs({At("bag/part.db3")}, {At("bag")}); }),
              HasSubstr("is an input too"));
  Outputs({At("bag/new.csv")}, {At("bag")});
  // inputs and outputs that are known later
  Outputs outputs({At("o.json")}, {At("log.csv")});
  EXPECT_THAT(test::RefusalOf([&] { outputs.Add(At("link"), "x"); }), HasSubstr("input"));
  Outputs page({At("log.csv")}, {});
  EXPECT_THAT(test::RefusalOf([&] { page.AddInputs({At("log.csv")}); }), HasSubstr("input"));
  EXPECT_EQ(ReadWholeFile(At("log.csv")), "mine");
}

TEST_F(OutputsTest, TwoInOneFileAreRefused) {
  Outputs outputs({At("o.json")}, {});
  EXPECT_THAT(test::RefusalOf([&] { outputs.Add(At("./o.json"), "x"); }), HasSubstr("two outputs"));
}

}  // namespace
}  // namespace warmjoint
